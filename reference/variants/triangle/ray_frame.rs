//! Projects the triangle along the ray, onto two axes perpendicular to it. In this plane the ray is
//! a point, and the weights are ratios of areas.

use glam::Vec2;
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
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let (right, up) = ray.dir.any_orthonormal_pair();
        let seen = |corner: Vertex| {
            let s = corner.position - ray.origin;
            (Vec2::new(s.dot(right), s.dot(up)), s.dot(ray.dir))
        };
        let [(a, depth_a), (b, depth_b), (c, depth_c)] =
            [seen(self.p0), seen(self.p1), seen(self.p2)];

        // The ray is projected to the point (0, 0).
        let (w, u, v) = (b.perp_dot(c), c.perp_dot(a), a.perp_dot(b));
        let area = w + u + v;
        if area == 0.0 {
            return None;
        }
        let (w, u, v) = (w / area, u / area, v / area);
        if w.min(u).min(v) < 0.0 {
            return None;
        }
        let t = w * depth_a + u * depth_b + v * depth_c;
        ray.range.contains(t).then(|| self.trace(ray, t, u, v))
    }

    /// Returns the trace for the hit at distance `t`, where p1 has the weight `u` and p2 has `v`.
    fn trace(&self, ray: &Ray, t: f32, u: f32, v: f32) -> Trace {
        let w = 1.0 - u - v;
        Trace {
            distance: t,
            position: ray.at(t),
            normal: (w * self.p0.normal + u * self.p1.normal + v * self.p2.normal).normalize(),
            uv: w * self.p0.uv + u * self.p1.uv + v * self.p2.uv,
            origin: ray.origin,
            material: self.material,
        }
    }
}
