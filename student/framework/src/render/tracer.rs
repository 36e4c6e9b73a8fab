//! Traces rays with the submission's code and checks its hits before they are used.

use std::time::Instant;

use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, Ray, Shape};

use crate::render::offset;
use crate::render::renderer::{InvalidSample, RenderStats};
use crate::scene::Scene;
use crate::submission::World;

/// A scene, both as data and in a submission's own types.
#[derive(Clone, Copy)]
pub(super) struct Tracer<'a> {
    pub(super) scene: &'a Scene,
    pub(super) world: &'a World,
}

/// The surface at the point where a path hits it.
pub(super) struct Surface<'a> {
    pub(super) shape: &'a Shape,
    /// The origin of the ray that hit the surface.
    pub(super) eye: Vec3,
    /// The direction from the surface back to `eye`.
    pub(super) out: Vec3,
    pub(super) position: Vec3,
    /// The unit normal on the side that the ray comes from.
    pub(super) normal: Vec3,
    /// Whether the submission's normal points to the side that the ray comes from.
    pub(super) outside: bool,
    pub(super) uv: Vec2,
}

impl<'a> Tracer<'a> {
    /// Returns the ray from the camera through a position in a pixel, in world space.
    pub(super) fn camera_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let ray = self.world.camera.ray(pixel, offset);
        self.scene.camera.placement.to_world(&ray)
    }

    /// Returns the surface that a ray hits first, according to the submission's code.
    pub(super) fn intersect(
        &self,
        ray: &Ray,
        stats: &mut RenderStats,
    ) -> Result<Option<Surface<'a>>, InvalidSample> {
        stats.rays += 1;
        if !ray.origin.is_finite() || !ray.dir.is_finite() {
            return Err(InvalidSample);
        }
        let started = stats.time_in_hit.map(|_| Instant::now());
        let hit = self.world.bvh.closest_hit(ray);
        if let (Some(time), Some(started)) = (&mut stats.time_in_hit, started) {
            *time += started.elapsed();
        }
        let Some(trace) = hit else {
            return Ok(None);
        };
        // In a scene, a shape's number is its index.
        let shape = self.scene.shapes.get(trace.shape as usize);
        let (Some(shape), Some(normal)) = (shape, trace.normal.try_normalize()) else {
            return Err(InvalidSample);
        };
        if !trace.position.is_finite() || !trace.uv.is_finite() {
            return Err(InvalidSample);
        }
        let outside = ray.dir.dot(normal) < 0.0;
        Ok(Some(Surface {
            shape,
            eye: ray.origin,
            out: -ray.dir,
            position: trace.position,
            normal: if outside { normal } else { -normal },
            outside,
            uv: trace.uv,
        }))
    }
}

impl Surface<'_> {
    /// Returns the ray that leaves the surface in direction `dir` and ends at distance `max`. It
    /// starts far enough away not to hit the surface itself.
    pub(super) fn leave(&self, dir: Vec3, max: f32) -> Ray {
        let min = offset::along_ray(self.shape, self.eye, self.position, dir);
        Ray {
            origin: self.position,
            dir,
            range: Interval::new(min, max),
        }
    }
}
