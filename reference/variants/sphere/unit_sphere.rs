//! Takes the ray to where the sphere is the unit sphere around the origin. Its direction gets
//! another length there, so t stays what it was: Pharr, Jakob and Humphreys, "Physically Based
//! Rendering" (4th edition), section 6.2.

use std::f32::consts::{PI, TAU};

use framework::math;
use glam::{Vec2, Vec3, vec2};
use protocol::{Ray, Trace};

use crate::bbox::BBox;

/// A sphere in world space.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    /// Its centre.
    pub center: Vec3,
    /// Its radius; above zero.
    pub radius: f32,
    /// What it is made of, for the [`Trace`].
    pub material: u32,
}

impl Sphere {
    /// A sphere from its parts.
    pub fn new(center: Vec3, radius: f32, material: u32) -> Self {
        Sphere {
            center,
            radius,
            material,
        }
    }

    /// The tightest box around the sphere.
    pub fn bbox(&self) -> BBox {
        BBox::new(self.center - self.radius, self.center + self.radius)
    }

    /// The texture coordinates of the point in direction `unit_dir`, **of length one**, from the
    /// centre: u once around the y-axis, v from 0 at the lowest point to 1 at the highest.
    pub fn uv(unit_dir: Vec3) -> Vec2 {
        let u = math::atan2(unit_dir.z, unit_dir.x) / TAU;
        let v = math::acos(-unit_dir.y.clamp(-1.0, 1.0)) / PI;
        vec2(if u < 0.0 { u + 1.0 } else { u }, v)
    }

    /// Where the ray first meets the sphere within `ray.range`, if anywhere.
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
