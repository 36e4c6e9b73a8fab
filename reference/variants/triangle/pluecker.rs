// Uses Plücker coordinates to determine on which side of each edge the ray passes. For two lines
// (d1, m1) and (d2, m2), the side is the sign of d1·m2 + d2·m1. See Shoemake, "Plücker Coordinate
// Tutorial", Ray Tracing News 11(1), 1998.

use glam::Vec3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        // Positions are relative to p0, since the moments of a small, distant triangle would
        // otherwise have large rounding errors.
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
        ray.range.contains(t).then(|| self.trace_at(ray, t, u, v))
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

    /// Returns a number whose sign indicates on which side the lines pass each other. The number is
    /// zero if they intersect or are parallel.
    fn side(self, other: Line) -> f32 {
        self.dir.dot(other.moment) + other.dir.dot(self.moment)
    }
}
