//! Plücker coordinates: on which side of each edge the ray passes. Two lines (d, m) pass each
//! other as d1·m2 + d2·m1 says: Shoemake, "Plücker Coordinate Tutorial", Ray Tracing News 11(1),
//! 1998.

use glam::Vec3;
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
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // Seen from p0, so that the moments of a small triangle far away are not all rounding.
        let line = Line::through(ray.origin - self.p0.position, ray.dir);
        let b = self.p1.position - self.p0.position;
        let c = self.p2.position - self.p0.position;

        let w = line.side(Line::through(b, c - b));
        let u = line.side(Line::through(Vec3::ZERO, -c));
        let v = line.side(Line::through(Vec3::ZERO, b));
        let all_left = u >= 0.0 && v >= 0.0 && w >= 0.0;
        let all_right = u <= 0.0 && v <= 0.0 && w <= 0.0;
        let sum = u + v + w;
        if !(all_left || all_right) || sum == 0.0 {
            return None;
        }

        let (u, v) = (u / sum, v / sum);
        let t = (u * b + v * c + self.p0.position - ray.origin).dot(ray.dir);
        ray.range.contains(t).then(|| self.trace(ray, t, u, v))
    }

    /// What is to be told of the place at distance `t`, where p1 weighs `u` and p2 weighs `v`.
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

/// A directed line in Plücker coordinates.
#[derive(Clone, Copy)]
struct Line {
    dir: Vec3,
    moment: Vec3,
}

impl Line {
    fn through(point: Vec3, dir: Vec3) -> Self {
        Line {
            dir,
            moment: point.cross(dir),
        }
    }

    /// Zero where the lines meet; its sign says on which side they pass each other.
    fn side(self, other: Line) -> f32 {
        self.dir.dot(other.moment) + other.dir.dot(self.moment)
    }
}
