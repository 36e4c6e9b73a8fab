//! Transforms the ray into the space where the sphere is the unit sphere around the origin. The
//! direction is scaled too, so t does not change. See Pharr, Jakob and Humphreys, "Physically Based
//! Rendering" (4th edition), section 6.2.

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
        let origin = (ray.origin - self.center) / self.radius;
        let dir = ray.dir / self.radius;
        let a = dir.length_squared();
        let half_b = origin.dot(dir);
        let discriminant = half_b * half_b - a * (origin.length_squared() - 1.0);
        if discriminant < 0.0 {
            return None;
        }

        let near = (-half_b - discriminant.sqrt()) / a;
        let far = (-half_b + discriminant.sqrt()) / a;
        let t = [near, far].into_iter().find(|t| ray.range.contains(*t))?;
        let normal = (origin + t * dir).normalize();
        Some(Trace {
            distance: t,
            position: self.center + self.radius * normal,
            normal,
            uv: Sphere::uv(normal),
            origin: ray.origin,
            material: self.material,
        })
    }
}
