//! Task 2, step 1: rays against triangles. Handout: "Where a ray meets a triangle".
//!
//! ```text
//!                 p2
//!                ╱ ╲                P = w·p0 + u·p1 + v·p2,   w = 1 − u − v
//!           e2  ╱   ╲                 = p0 + u·e1 + v·e2
//!              ╱  P  ╲              P = o + t·d
//!            p0───────p1
//!                e1                 three equations for u, v and t
//! ```

use protocol::{Ray, Trace, Vertex};

use crate::bbox::BBox;

/// A triangle in world space.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// The corner with weight `w = 1 − u − v`.
    pub p0: Vertex,
    /// The corner with weight `u`.
    pub p1: Vertex,
    /// The corner with weight `v`.
    pub p2: Vertex,
    /// What it is made of, for the [`Trace`].
    pub material: u32,
}

impl Triangle {
    /// A triangle from its parts.
    pub fn new(p0: Vertex, p1: Vertex, p2: Vertex, material: u32) -> Self {
        Triangle {
            p0,
            p1,
            p2,
            material,
        }
    }

    /// The tightest box around the triangle; flat if the triangle lies along an axis.
    pub fn bbox(&self) -> BBox {
        let mut bbox = BBox::EMPTY;
        bbox.enclose_point(self.p0.position);
        bbox.enclose_point(self.p1.position);
        bbox.enclose_point(self.p2.position);
        bbox
    }

    /// Where the ray meets the triangle within `ray.range`, if anywhere.
    ///
    /// - Both sides count, and so do the edges. `ray.range` includes its ends.
    /// - `distance` is the algorithm's t; `position` the point there; `origin` the ray's.
    /// - `normal` and `uv` are interpolated between the corners with weights w, u, v. The normal
    ///   is never flipped toward the ray, and need not be brought to length one.
    /// - A triangle of edge 1e-3 is as good as any. One without area, or one that the ray is
    ///   parallel to, is not met.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // solution
        // starter: todo!("task 2, triangle: where does {ray:?} meet {self:?}?")
        // Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of
        // Graphics Tools 2(1), 1997; in the slides' form of Cramer's rule.
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;
        let s = ray.origin - self.p0.position;

        let e1_x_d = e1.cross(ray.dir);
        let determinant = e1_x_d.dot(e2);
        // No small number will do in place of zero: the determinant shrinks with the area.
        if determinant == 0.0 {
            return None;
        }

        let inverse = 1.0 / determinant;
        let s_x_e2 = s.cross(e2);
        let u = -s_x_e2.dot(ray.dir) * inverse;
        let v = e1_x_d.dot(s) * inverse;
        let w = 1.0 - u - v;
        // The least of three, and not three comparisons: none of those can be guessed.
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

    /// The lower left half of the unit square, facing +z.
    fn half_square() -> Triangle {
        let corner = |x, y| Vertex::new(vec3(x, y, 0.0), Vec3::Z, vec2(x, y));
        Triangle::new(corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0), 7)
    }

    // starter: #[ignore = "task 2: not written yet"]
    #[test]
    fn a_ray_through_the_inside_hits() {
        let ray = Ray::new(vec3(0.2, 0.3, 2.0), Vec3::NEG_Z);
        let trace = half_square().hit(&ray).expect("it points at the triangle");
        let Trace {
            distance,
            position,
            uv,
            ..
        } = trace;
        assert!(
            (distance - 2.0).abs() < 1e-5,
            "distance is {distance}, wanted 2"
        );
        let wanted = vec3(0.2, 0.3, 0.0);
        assert!(
            position.abs_diff_eq(wanted, 1e-5),
            "position is {position}, wanted {wanted}"
        );
        let wanted = vec2(0.2, 0.3);
        assert!(uv.abs_diff_eq(wanted, 1e-5), "uv is {uv}, wanted {wanted}");
        assert_eq!(trace.material, 7, "the material");
    }

    // starter: #[ignore = "task 2: not written yet"]
    #[test]
    fn the_other_half_of_the_square_is_not_hit() {
        let ray = Ray::new(vec3(0.8, 0.7, 2.0), Vec3::NEG_Z);
        let trace = half_square().hit(&ray);
        assert!(trace.is_none(), "wanted None, got {trace:?}");
    }

    // starter: #[ignore = "task 2: not written yet"]
    #[test]
    fn from_behind_the_normal_stays_as_it_is() {
        let ray = Ray::new(vec3(0.2, 0.3, -2.0), Vec3::Z);
        let trace = half_square().hit(&ray).expect("both sides count");
        let (got, wanted) = (trace.normal, Vec3::Z);
        assert!(
            got.abs_diff_eq(wanted, 1e-5),
            "normal is {got}, wanted {wanted}"
        );
    }
}
