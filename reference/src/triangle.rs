//! Task 2, step 1: intersecting rays with triangles. Handout: "Ray-triangle intersection".
//!
//! ```text
//!                 p2
//!                ╱ ╲                P = w·p0 + u·p1 + v·p2,   w = 1 − u − v
//!           e2  ╱   ╲                 = p0 + u·e1 + v·e2
//!              ╱  P  ╲              P = o + t·d
//!            p0───────p1
//!                e1                 three equations for u, v and t
//! ```
//!
//! On the slides, `Trace Triangle::hit(const Ray &ray)` returns a `Trace` with a flag `hit`. Here,
//! [`Triangle::hit`] returns an `Option<Trace>`: `None` means that there is no hit.

use protocol::{Ray, Trace, Vertex};

use crate::bbox::BBox;

/// A triangle in world space.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// The corner with the weight `w = 1 − u − v`.
    pub p0: Vertex,
    /// The corner with the weight `u`.
    pub p1: Vertex,
    /// The corner with the weight `v`.
    pub p2: Vertex,
    /// The index of the material, to be copied into the [`Trace`].
    pub material: u32,
}

impl Triangle {
    /// Creates a triangle.
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, material: u32) -> Self {
        Triangle {
            p0,
            p1,
            p2,
            material,
        }
    }

    /// Returns the tightest box around the triangle. It is flat if the triangle lies in an
    /// axis-aligned plane.
    pub fn bbox(&self) -> BBox {
        let mut bbox = BBox::EMPTY;
        bbox.enclose_point(self.p0.position);
        bbox.enclose_point(self.p1.position);
        bbox.enclose_point(self.p2.position);
        bbox
    }

    /// Returns the ray's hit on the triangle, or `None` if there is none within `ray.range`.
    ///
    /// - The triangle can be hit from both sides, and its edges belong to it. `ray.range` includes
    ///   both of its ends.
    /// - `distance` is the t of the equations at the top of this file, `position` is the point at
    ///   that distance, and `origin` is the ray's origin.
    /// - `normal` and `uv` are interpolated between the corners with the weights w, u and v. Do not
    ///   flip the normal toward the ray. It does not have to have length one.
    /// - Triangles of every size count, be they a thousandth or a millionth as large. A triangle without
    ///   area is never hit, and neither is one that is parallel to the ray.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // solution
        // starter: todo!("task 2, triangle: where does {ray:?} hit {self:?}?")
        // Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of
        // Graphics Tools 2(1), 1997, with Cramer's rule written as on the slides.
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;
        let s = ray.origin - self.p0.position;

        let e1_x_d = e1.cross(ray.dir);
        let determinant = e1_x_d.dot(e2);
        // Exactly 0 and not an epsilon, because the determinant shrinks with the triangle's area.
        if determinant == 0.0 {
            return None;
        }

        let inverse = 1.0 / determinant;
        let s_x_e2 = s.cross(e2);
        let u = -s_x_e2.dot(ray.dir) * inverse;
        let v = e1_x_d.dot(s) * inverse;
        let w = 1.0 - u - v;
        // One comparison with the smallest weight is faster than three comparisons, which the
        // branch predictor could not guess.
        if glam::vec3(w, u, v).min_element() < 0.0 {
            return None;
        }

        let t = -s_x_e2.dot(e1) * inverse;
        if !ray.range.contains(t) {
            return None;
        }
        Some(Trace {
            distance: t,
            position: ray.at(t),
            normal: (w * self.p0.normal + u * self.p1.normal + v * self.p2.normal).normalize(),
            uv: w * self.p0.uv + u * self.p1.uv + v * self.p2.uv,
            origin: ray.origin,
            material: self.material,
        })
        // end solution
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec2, vec3};

    use super::*;

    /// The lower left half of the unit square in the plane z = 0, facing +z.
    fn half_square() -> Triangle {
        let corner = |x, y| Vertex::new(vec3(x, y, 0.0), Vec3::Z, vec2(x, y));
        Triangle::new(corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0), 7)
    }

    // starter: #[ignore = "task 2: not written yet"]
    #[test]
    fn a_ray_through_the_inside_hits() {
        let ray = Ray::new(vec3(0.2, 0.3, 2.0), Vec3::NEG_Z);
        let trace = half_square().hit(&ray).expect("expected a hit, got None");
        let Trace {
            distance,
            position,
            uv,
            ..
        } = trace;
        assert!(
            (distance - 2.0).abs() < 1e-5,
            "expected distance 2, got {distance}"
        );
        let expected = vec3(0.2, 0.3, 0.0);
        assert!(
            position.abs_diff_eq(expected, 1e-5),
            "expected position {expected}, got {position}"
        );
        let expected = vec2(0.2, 0.3);
        assert!(
            uv.abs_diff_eq(expected, 1e-5),
            "expected uv {expected}, got {uv}"
        );
        assert_eq!(
            trace.material, 7,
            "wrong material: left is yours, right is correct"
        );
    }

    // starter: #[ignore = "task 2: not written yet"]
    #[test]
    fn the_other_half_of_the_square_is_not_hit() {
        let ray = Ray::new(vec3(0.8, 0.7, 2.0), Vec3::NEG_Z);
        let trace = half_square().hit(&ray);
        assert!(trace.is_none(), "expected None, got {trace:?}");
    }

    // starter: #[ignore = "task 2: not written yet"]
    #[test]
    fn from_behind_the_normal_stays_as_it_is() {
        let ray = Ray::new(vec3(0.2, 0.3, -2.0), Vec3::Z);
        let trace = half_square().hit(&ray).expect("expected a hit, got None");
        let (got, expected) = (trace.normal, Vec3::Z);
        assert!(
            got.abs_diff_eq(expected, 1e-5),
            "expected normal {expected}, got {got}"
        );
    }
}
