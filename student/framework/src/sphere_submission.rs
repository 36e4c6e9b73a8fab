//! A submission to test the framework with: no real one is at hand here.

use glam::{UVec2, Vec2, Vec3};
use protocol::{Interval, PinholeCamera, Ray, Shape, Trace, TreeNode};

use crate::submission::{Aggregate, CameraRays, Hierarchy, Submission};

/// Spheres only, by a formula of our own; `spoil` is applied to every answer.
pub(crate) struct SphereSubmission {
    pub(crate) alter: fn(Trace) -> Trace,
}

/// Answers as it should.
pub(crate) const CORRECT: SphereSubmission = SphereSubmission {
    alter: |trace| trace,
};

struct SquareCamera {
    film: UVec2,
}

struct SphereList {
    shapes: Vec<Shape>,
    spoil: fn(Trace) -> Trace,
}

impl Submission for SphereSubmission {
    fn camera(&self, lens: &PinholeCamera) -> Box<dyn CameraRays> {
        Box::new(SquareCamera { film: lens.film })
    }

    fn build(&self, shapes: &[Shape], _: usize) -> Box<dyn Hierarchy> {
        Box::new(SphereList {
            shapes: shapes.to_vec(),
            spoil: self.alter,
        })
    }

    fn primitive_list(&self, shapes: &[Shape]) -> Box<dyn Aggregate> {
        self.build(shapes, 1)
    }

    fn prebuilt_tree(&self, shapes: &[Shape], _: &[TreeNode], _: usize) -> Box<dyn Hierarchy> {
        self.build(shapes, 1)
    }

    fn intersect_box(&self, _: Vec3, _: Vec3, _: &Ray, _: Interval) -> Option<Interval> {
        None
    }
}

impl CameraRays for SquareCamera {
    /// A field of view of 90° on a square sensor.
    fn ray(&self, pixel: UVec2, offset: Vec2) -> Ray {
        let place = (pixel.as_vec2() + offset) / self.film.as_vec2() * 2.0 - 1.0;
        Ray::new(Vec3::ZERO, place.extend(-1.0))
    }
}

impl Aggregate for SphereList {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        let meet = |shape: &Shape| intersect(shape, ray);
        let nearest = self.shapes.iter().map(meet).fold(None, Trace::nearer);
        nearest.map(self.spoil)
    }
}

/// No tree: asked about all of them.
impl Hierarchy for SphereList {
    fn root(&self) -> usize {
        0
    }

    fn node_count(&self) -> usize {
        0
    }

    fn node(&self, place: usize) -> TreeNode {
        unreachable!("there is no node {place}")
    }

    fn primitive_count(&self) -> usize {
        0
    }

    fn material(&self, place: usize) -> u32 {
        unreachable!("none is told of, nor the material of {place}")
    }
}

/// Geometrically: the closest approach to the centre, then half a chord to either side.
fn intersect(shape: &Shape, ray: &Ray) -> Option<Trace> {
    let Shape::Sphere {
        center,
        radius,
        material,
    } = *shape
    else {
        return None;
    };
    let along = (center - ray.origin).dot(ray.dir);
    let miss = (center - ray.origin) - along * ray.dir;
    let half_chord = (radius * radius - miss.length_squared()).max(0.0).sqrt();
    let times = [along - half_chord, along + half_chord];
    let touches = miss.length() <= radius;
    let distance = times
        .into_iter()
        .find(|&t| ray.range.contains(t) && touches)?;
    let position = ray.at(distance);
    Some(Trace {
        distance,
        position,
        normal: (position - center) / radius,
        uv: Vec2::ZERO,
        origin: ray.origin,
        material,
    })
}
