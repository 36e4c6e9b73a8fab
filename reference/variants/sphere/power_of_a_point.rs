//! Computes the roots from their mean, which is the distance of the closest approach, and their
//! product, which is the power of the origin with respect to the sphere: mean ± √(mean² − product).

use std::f32::consts::{PI, TAU};

use framework::math;
use glam::{Vec2, Vec3, vec2};
use protocol::{Ray, Trace};

use crate::bbox::BBox;

/// A sphere in world space.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    /// The centre.
    pub center: Vec3,
    /// The radius, greater than zero.
    pub radius: f32,
    /// The index of the material, to be copied into the [`Trace`].
    pub material: u32,
}

impl Sphere {
    /// Creates a sphere.
    pub fn new(center: Vec3, radius: f32, material: u32) -> Self {
        Sphere {
            center,
            radius,
            material,
        }
    }

    /// Returns the tightest box around the sphere.
    pub fn bbox(&self) -> BBox {
        BBox::new(self.center - self.radius, self.center + self.radius)
    }

    /// Returns the texture coordinates of the point in the direction `unit_dir` from the centre.
    /// The direction must have **length one**. u runs from 0 to 1 around the y-axis, and v from 0
    /// at the lowest point to 1 at the highest.
    pub fn uv(unit_dir: Vec3) -> Vec2 {
        let u = math::atan2(unit_dir.z, unit_dir.x) / TAU;
        let v = math::acos(-unit_dir.y.clamp(-1.0, 1.0)) / PI;
        vec2(if u < 0.0 { u + 1.0 } else { u }, v)
    }

    /// Returns the ray's first hit on the sphere, or `None` if there is none within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // The power of a point is the product near · far, which is the same for all lines through
        // the point.
        let from_center = ray.origin.distance(self.center);
        let product = (from_center - self.radius) * (from_center + self.radius);
        let middle = (self.center - ray.origin)
            .project_onto_normalized(ray.dir)
            .dot(ray.dir);
        if middle * middle < product {
            return None;
        }

        let half_chord = (middle * middle - product).sqrt();
        let t = Some(middle - half_chord)
            .filter(|near| ray.range.contains(*near))
            .or(Some(middle + half_chord))
            .filter(|t| ray.range.contains(*t))?;
        Some(self.trace(ray, t))
    }

    /// Returns the trace for the hit at distance `t`.
    fn trace(&self, ray: &Ray, t: f32) -> Trace {
        let position = ray.at(t);
        let normal = (position - self.center).normalize();
        Trace {
            distance: t,
            position,
            normal,
            uv: Sphere::uv(normal),
            origin: ray.origin,
            material: self.material,
        }
    }
}
