//! Leaves out a, which is one since directions have length one; without a test of its own a
//! negative discriminant gives NaN, which is in no range.

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
        let to_center = self.center - ray.origin;
        let b = to_center.dot(ray.dir);
        let root = (b * b - to_center.length_squared() + self.radius * self.radius).sqrt();
        let (near, far) = (b - root, b + root);

        let t = [near, far].into_iter().find(|t| ray.range.contains(*t))?;
        Some(self.trace(ray, t))
    }

    /// What is to be told of the place at distance `t`.
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
