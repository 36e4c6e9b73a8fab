//! The normal is the way from the centre divided by the radius: of length one but for rounding.

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
        let o = ray.origin - self.center;
        let b = o.dot(ray.dir);
        let c = o.dot(o) - self.radius * self.radius;
        let discriminant = b * b - c;
        if discriminant < 0.0 {
            return None;
        }

        let root = discriminant.sqrt();
        let mut t = -b - root;
        if !ray.range.contains(t) {
            t = -b + root;
        }
        if !ray.range.contains(t) {
            return None;
        }

        let position = ray.at(t);
        let normal = (position - self.center) / self.radius;
        Some(Trace {
            distance: t,
            position,
            normal,
            uv: Sphere::uv(normal),
            origin: ray.origin,
            material: self.material,
        })
    }
}
