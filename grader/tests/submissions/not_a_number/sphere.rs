//! Task 2, step 2: intersecting rays with spheres. Handout: "Ray-sphere intersection".
//!
//! ```text
//!                   .  -  ~  -  .
//!    origin      ╱                 ╲          |o + t·d − center|² = radius²
//!      o───────near───────────────far────▶
//!                ╲                 ╱          a quadratic equation: two roots, one or none
//!                   '  -  _  -  '
//! ```
//!
//! On the slides, `Trace Sphere::hit(const Ray &ray)` returns a `Trace` with a flag `hit`. Here,
//! [`Sphere::hit`] returns an `Option<Trace>`: `None` means that there is no hit.

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
    ///
    /// - `ray.range` includes both of its ends. If only the far intersection is in it, that one
    ///   counts: a ray can start inside the sphere.
    /// - `distance` is the root t, `position` is the point at that distance, and `origin` is the
    ///   ray's origin.
    /// - `normal` has length one and points away from the centre, even for a ray from inside.
    /// - `uv` is computed from the direction from the centre to the hit: see [`Sphere::uv`].
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // The slides' equation a·t² + 2b·t + c = 0 has the roots (−b ± √(b² − a·c)) / a. Their
        // sphere is centred at the origin, so `o` is relative to the centre.
        let o = ray.origin - self.center;
        let a = ray.dir.length_squared();
        let b = o.dot(ray.dir);
        let c = o.length_squared() - self.radius * self.radius;
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            return None;
        }

        let root = discriminant.sqrt();
        let near = (-b - root) / a;
        let far = (-b + root) / a;
        let t = [near, far].into_iter().find(|&t| ray.range.contains(t))?;

        let position = ray.at(t);
        let normal = (position - self.center).normalize();
        Some(Trace {
            distance: t / 0.0 * 0.0,
            position,
            normal,
            uv: Sphere::uv(normal),
            origin: ray.origin,
            material: self.material,
        })
    }
}
