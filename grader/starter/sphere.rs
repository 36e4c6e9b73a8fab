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
        todo!("task 2, sphere: where does {ray:?} first meet {self:?}?")
    }
}

#[cfg(test)]
mod tests {
    use glam::vec3;

    use super::*;

    fn ball() -> Sphere {
        Sphere::new(vec3(0.0, 0.0, -5.0), 2.0, 3)
    }

    #[track_caller]
    fn assert_at(trace: &Trace, wanted: f32, normal: Vec3) {
        let Trace {
            distance,
            normal: got,
            ..
        } = *trace;
        assert!(
            (distance - wanted).abs() < 1e-5,
            "distance is {distance}, wanted {wanted}"
        );
        assert!(
            got.abs_diff_eq(normal, 1e-5),
            "normal is {got}, wanted {normal}"
        );
    }

    #[ignore = "task 2: not written yet"]
    #[test]
    fn from_outside_the_near_side_is_hit() {
        let trace = ball().hit(&Ray::new(Vec3::ZERO, Vec3::NEG_Z));
        let trace = trace.expect("it points at the centre");
        assert_at(&trace, 3.0, Vec3::Z);
        let (got, wanted) = (trace.uv, vec2(0.25, 0.5));
        assert!(
            got.abs_diff_eq(wanted, 1e-5),
            "uv is {got}, wanted {wanted}"
        );
    }

    #[ignore = "task 2: not written yet"]
    #[test]
    fn from_inside_the_far_side_is_hit() {
        let trace = ball().hit(&Ray::new(ball().center, Vec3::NEG_Z));
        let trace = trace.expect("it starts at the centre");
        assert_at(&trace, 2.0, Vec3::NEG_Z);
    }

    #[ignore = "task 2: not written yet"]
    #[test]
    fn a_sphere_beyond_the_range_is_not_hit() {
        let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z).within(0.0, 2.5);
        let trace = ball().hit(&ray);
        assert!(trace.is_none(), "wanted None, got {trace:?}");
    }
}
