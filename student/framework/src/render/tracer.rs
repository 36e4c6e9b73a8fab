//! Traces rays with the submission's code and checks its hits before they are used.

use std::cell::{Cell, RefCell};
use std::time::Instant;

use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, Ray, Shape, Trace};

use crate::render::offset;
use crate::render::renderer::{InvalidSample, RenderStats};
use crate::scene::{Material, Scene};
use crate::submission::World;

/// The maximum number of rays of a path. It is several times the number that a path needs with the
/// highest number of bounces, 10,000.
const MAX_RAYS: u32 = 1 << 17;

/// A scene, both as data and in a submission's own types.
#[derive(Clone, Copy)]
pub struct Tracer<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The same scene in the submission's types.
    pub world: &'a World,
}

/// The surface at the point where a path hits it.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// The shape.
    pub shape: &'a Shape,
    /// The shape's material.
    pub material: &'a Material,
    /// The origin of the ray that hit the surface.
    pub eye: Vec3,
    /// The direction from the surface back to `eye`.
    pub out: Vec3,
    /// The point that the ray hit.
    pub position: Vec3,
    /// The unit normal on the side that the ray comes from.
    pub normal: Vec3,
    /// Whether the submission's normal points to the side that the ray comes from.
    pub outside: bool,
    /// The texture coordinates.
    pub uv: Vec2,
}

impl<'a> Tracer<'a> {
    /// Returns the ray from the camera through a position in a pixel, in world space.
    pub fn camera_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let ray = self.world.camera.ray(pixel, offset);
        self.scene.camera.placement.to_world(&ray)
    }

    /// Returns the surface that a ray hits first, according to the submission's code.
    ///
    /// # Errors
    /// Fails if the ray or the submission's hit is unusable.
    pub fn intersect(
        &self,
        ray: &Ray,
        stats: &mut RenderStats,
    ) -> Result<Option<Surface<'a>>, InvalidSample> {
        stats.rays += 1;
        if !ray.origin.is_finite() || !ray.dir.is_finite() {
            return Err(InvalidSample::Hit);
        }
        let started = stats.time_in_hit.map(|_| Instant::now());
        let hit = self.world.bvh.closest_hit(ray);
        if let (Some(time), Some(started)) = (&mut stats.time_in_hit, started) {
            *time += started.elapsed();
        }
        hit.map(|trace| Surface::new(self.scene, ray, &trace))
            .transpose()
    }
}

impl<'a> Surface<'a> {
    /// Returns the surface in a scene at a ray's hit.
    ///
    /// # Errors
    /// Fails if the hit is unusable.
    pub fn new(scene: &'a Scene, ray: &Ray, trace: &Trace) -> Result<Self, InvalidSample> {
        // In a scene, a shape's number is its index.
        let shape = scene.shapes.get(trace.shape as usize);
        let material = scene.material_of(trace.shape);
        let normal = trace.normal.try_normalize();
        let (Some(shape), Some(material), Some(normal)) = (shape, material, normal) else {
            return Err(InvalidSample::Hit);
        };
        if !trace.position.is_finite() || !trace.uv.is_finite() {
            return Err(InvalidSample::Hit);
        }
        let outside = ray.dir.dot(normal) < 0.0;
        Ok(Surface {
            shape,
            material,
            eye: ray.origin,
            out: -ray.dir,
            position: trace.position,
            normal: if outside { normal } else { -normal },
            outside,
            uv: trace.uv,
        })
    }

    /// Returns the ray that leaves the surface in direction `dir` and ends at distance `max`. It
    /// starts far enough away not to hit the surface itself.
    pub fn leave(&self, dir: Vec3, max: f32) -> Ray {
        let min = offset::along_ray(self.shape, self.eye, self.position, dir);
        Ray {
            origin: self.position,
            dir,
            range: Interval::new(min, max),
        }
    }
}

/// Finds the surface that a ray hits first.
pub trait Intersect {
    /// Returns the surface that the ray hits first, or `None` if it hits nothing.
    fn intersect(&self, ray: &Ray) -> Option<Surface<'_>>;
}

/// Traces the rays of one sample, which is discarded at the end if one of them had an unusable hit.
/// So the code that follows a path needs no error handling.
pub struct SampleTracer<'a> {
    tracer: &'a Tracer<'a>,
    stats: RefCell<&'a mut RenderStats>,
    is_invalid: Cell<bool>,
    /// The number of rays so far.
    rays: Cell<u32>,
    /// The last ray and its hit. Direct light and the path itself often ask for the same ray, one
    /// after the other.
    last: RefCell<Option<(Ray, Option<Surface<'a>>)>>,
}

impl<'a> SampleTracer<'a> {
    /// Starts a sample.
    pub fn new(tracer: &'a Tracer<'a>, stats: &'a mut RenderStats) -> Self {
        SampleTracer {
            tracer,
            stats: RefCell::new(stats),
            is_invalid: Cell::new(false),
            rays: Cell::new(0),
            last: RefCell::new(None),
        }
    }

    /// Returns the sample's radiance.
    ///
    /// # Errors
    /// Fails if a ray had an unusable hit, or if the radiance isn't finite.
    pub fn finish(self, radiance: Vec3) -> Result<Vec3, InvalidSample> {
        if self.is_invalid.get() {
            Err(InvalidSample::Hit)
        } else if radiance.is_finite() {
            Ok(radiance)
        } else {
            Err(InvalidSample::Radiance)
        }
    }
}

impl Intersect for SampleTracer<'_> {
    /// Returns `None` from the first unusable hit on, so that the path soon ends.
    ///
    /// # Panics
    /// If the path has far more rays than any path needs.
    fn intersect(&self, ray: &Ray) -> Option<Surface<'_>> {
        self.rays.set(self.rays.get() + 1);
        assert!(
            self.rays.get() <= MAX_RAYS,
            "the path never ends: it is still going after {MAX_RAYS} rays"
        );
        if self.is_invalid.get() {
            return None;
        }
        if let Some((last, hit)) = &*self.last.borrow()
            && last == ray
        {
            return *hit;
        }
        let hit = self.tracer.intersect(ray, &mut self.stats.borrow_mut());
        let hit = hit.unwrap_or_else(|_| {
            self.is_invalid.set(true);
            None
        });
        *self.last.borrow_mut() = Some((*ray, hit));
        hit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{CORRECT, SphereSubmission, scene};

    #[test]
    fn a_sample_with_an_unusable_hit_or_radiance_is_discarded() {
        let scene = scene(
            0.0,
            r#""grey": { "lambertian": { "albedo": [0.5, 0.5, 0.5] } }"#,
            r#"{ "sphere": { "center": [0, 0, -3], "radius": 1, "material": "grey" } }"#,
        );
        let nowhere = SphereSubmission {
            alter: |trace| trace.position = Vec3::NAN,
            ..CORRECT
        };
        let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
        for (submission, radiance, invalid) in [
            (CORRECT, Vec3::ONE, None),
            (CORRECT, Vec3::NAN, Some(InvalidSample::Radiance)),
            (nowhere, Vec3::ONE, Some(InvalidSample::Hit)),
        ] {
            let world = World::new(&submission, &scene);
            let tracer = Tracer {
                scene: &scene,
                world: &world,
            };
            let mut stats = RenderStats::default();
            let sample = SampleTracer::new(&tracer, &mut stats);
            let hits = [sample.intersect(&ray), sample.intersect(&ray)].map(|hit| hit.is_some());
            let is_usable = (submission.alter as usize) == (CORRECT.alter as usize);
            assert_eq!(hits, [is_usable; 2]);
            assert_eq!(sample.finish(radiance).err(), invalid);
        }
    }

    #[test]
    #[should_panic(expected = "the path never ends")]
    fn an_endless_path_panics() {
        let scene = scene(0.0, "", "");
        let world = World::new(&CORRECT, &scene);
        let tracer = Tracer {
            scene: &scene,
            world: &world,
        };
        let mut stats = RenderStats::default();
        let sample = SampleTracer::new(&tracer, &mut stats);
        loop {
            sample.intersect(&Ray::new(Vec3::ZERO, Vec3::NEG_Z));
        }
    }
}
