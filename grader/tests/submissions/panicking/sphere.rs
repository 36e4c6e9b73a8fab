//! Task 2, step 2: rays against spheres. Handout: "Where a ray meets a sphere".
//!
//! ```text
//!                   .  -  ~  -  .
//!    origin      ╱                 ╲          |o + t·d − center|² = radius²
//!      o───────near───────────────far────▶
//!                ╲                 ╱          a quadratic: two roots, one or none
//!                   '  -  _  -  '
//! ```

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
    ///
    /// - `ray.range` includes its ends. If the near meeting lies outside it and the far one
    ///   inside, the far one counts: a ray can start inside the sphere.
    /// - `distance` is the root t; `position` the point there; `origin` the ray's.
    /// - `normal` has length one and points away from the centre, also when seen from inside.
    /// - `uv` is that of the direction from the centre to the meeting: see [`Sphere::uv`].
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // The slides' a·t² + 2b·t + c = 0, halved; for a sphere around the origin.
        let o = ray.origin - self.center;
        let a = ray.dir.length_squared();
        let b = o.dot(ray.dir);
        let c = o.length_squared() - self.radius * self.radius;
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            return None;
        }

        let roots = [discriminant.sqrt()];
        let root = roots[usize::from(self.center.x < 0.0)];
        let near = (-b - root) / a;
        let far = (-b + root) / a;
        let t = [near, far].into_iter().find(|&t| ray.range.contains(t))?;

        let position = ray.at(t);
        let normal = (position - self.center).normalize();
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
