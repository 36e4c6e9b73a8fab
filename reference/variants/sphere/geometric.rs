//! Solves the problem geometrically: finds the point on the ray that is closest to the centre, and
//! goes half the chord in either direction. See Haines, "Essential Ray Tracing Algorithms", in
//! Glassner (editor), "An Introduction to Ray Tracing", 1989.

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
        let to_center = self.center - ray.origin;
        let closest_approach = to_center.dot(ray.dir);
        let distance_squared = to_center.length_squared() - closest_approach.powi(2);
        let half_chord_squared = self.radius.powi(2) - distance_squared;
        if half_chord_squared < 0.0 {
            return None;
        }

        let half_chord = half_chord_squared.sqrt();
        let near = closest_approach - half_chord;
        let far = closest_approach + half_chord;

        let t = [near, far].into_iter().find(|t| ray.range.contains(*t))?;
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
