//! Parallelograms and triangles, and their intersections with rays.

use glam::{DVec2, DVec3};

/// A parallelogram, or the half of it next to its first corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatShape {
    /// The first corner.
    pub corner: DVec3,
    /// The two edges at that corner. From the front, the turn from the first edge to the second
    /// looks counterclockwise.
    pub edges: [DVec3; 2],
    /// Whether this is a triangle.
    pub is_triangle: bool,
}

/// The intersection of a ray's line with the plane of a shape.
///
/// `clearance` and `height` are lengths relative to the largest coordinate of the ray's origin and
/// the shape, because rounding errors are proportional to that coordinate.
#[derive(Clone, Copy, Debug)]
pub struct PlaneHit {
    /// The distance along the ray. May be negative.
    pub distance: f64,
    /// The cosine of the angle between the ray and the shape's normal: negative for a ray that
    /// arrives at the front.
    pub cosine: f64,
    /// How far the ray would have to move sideways to cross an edge: positive inside the shape and
    /// negative outside, where this is a lower bound.
    pub clearance: f64,
    /// The distance of the ray's origin from the plane. Negative if the plane is behind the ray.
    pub height: f64,
}

impl FlatShape {
    /// Returns the unit normal at the front.
    pub fn normal(&self) -> DVec3 {
        let [e0, e1] = self.edges;
        // Adding zero turns −0 into 0.
        e0.cross(e1).normalize() + DVec3::ZERO
    }

    /// Returns the area, from the lengths of the edges and their dot product.
    pub fn area(&self) -> f64 {
        let [e0, e1] = self.edges;
        let dot = e0.dot(e1);
        let whole = libm::sqrt(e0.length_squared() * e1.length_squared() - dot * dot);
        if self.is_triangle { 0.5 * whole } else { whole }
    }

    /// Returns the point whose position along the edges, as fractions of them, is `along`.
    pub fn at(&self, along: DVec2) -> DVec3 {
        self.corner + along.x * self.edges[0] + along.y * self.edges[1]
    }

    /// Intersects the line through `from` with the shape's plane. Returns `None` if they are
    /// parallel.
    ///
    /// Solves `from + t · direction = corner + a · e0 + b · e1` by Cramer's rule.
    pub fn intersect_plane(&self, from: DVec3, direction: DVec3) -> Option<PlaneHit> {
        let [e0, e1] = self.edges;
        let to_origin = from - self.corner;
        let volume = determinant(e0, e1, direction);
        if volume == 0.0 {
            return None;
        }
        let a = determinant(to_origin, e1, direction) / volume;
        let b = determinant(e0, to_origin, direction) / volume;
        let distance = -determinant(e0, e1, to_origin) / volume;

        let area = e0.cross(e1).length();
        let cosine = volume / (area * direction.length());
        let extent = self.extent().max(from.abs().max_element());
        Some(PlaneHit {
            distance,
            cosine,
            clearance: self.inset(a, b) * cosine.abs() / extent,
            height: distance * direction.length() * cosine.abs() / extent,
        })
    }

    /// Returns the distance of a point in the shape's plane from the nearest edge, or the negative
    /// distance from the farthest edge's line that the point is outside of.
    fn inset(&self, a: f64, b: f64) -> f64 {
        let [e0, e1] = self.edges;
        let area = e0.cross(e1).length();
        let from_lines = [a * area / e1.length(), b * area / e0.length()];
        let far = if self.is_triangle {
            let c = 1.0 - a - b;
            [c * area / (e1 - e0).length(); 2]
        } else {
            [
                (1.0 - a) * area / e1.length(),
                (1.0 - b) * area / e0.length(),
            ]
        };
        let all = from_lines.into_iter().chain(far);
        all.fold(f64::INFINITY, f64::min)
    }

    /// Returns the largest absolute value of a corner's coordinate.
    fn extent(&self) -> f64 {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE].map(|along| self.at(along));
        let all = corners.map(|corner| corner.abs().max_element());
        all.into_iter().fold(0.0, f64::max)
    }
}

impl PlaneHit {
    /// Returns whether the ray hits the shape.
    pub fn is_hit(&self) -> bool {
        self.height > 0.0 && self.clearance >= 0.0
    }

    /// Returns how far the ray is from changing [`PlaneHit::is_hit`]. A hit at a grazing angle is
    /// close to a miss.
    pub fn margin(&self) -> f64 {
        if self.is_hit() {
            self.clearance.min(self.cosine.abs()).min(self.height)
        } else {
            (-self.clearance).max(-self.height)
        }
    }
}

/// Returns the determinant of the matrix with these columns: the signed volume of the
/// parallelepiped that they span.
pub fn determinant(x: DVec3, y: DVec3, z: DVec3) -> f64 {
    x.cross(y).dot(z)
}

#[cfg(test)]
mod tests {
    use glam::{dvec2, dvec3};

    use super::*;

    /// A parallelogram at z = 2 whose front is up.
    const SLANTED: FlatShape = FlatShape {
        corner: DVec3::new(1.0, 0.0, 2.0),
        edges: [DVec3::new(4.0, 0.0, 0.0), DVec3::new(3.0, 3.0, 0.0)],
        is_triangle: false,
    };

    #[test]
    fn areas_and_normals_match_hand_computed_values() {
        assert!((SLANTED.area() - 12.0).abs() < 1e-14);
        assert_eq!(SLANTED.normal(), DVec3::Z);
        assert!(SLANTED.normal().x.is_sign_positive());
        let half = FlatShape {
            is_triangle: true,
            ..SLANTED
        };
        assert!((half.area() - 6.0).abs() < 1e-14);
    }

    #[test]
    fn a_ray_to_a_point_inside_hits_there() {
        let from = dvec3(-1.0, 3.0, 7.0);
        for along in [dvec2(0.1, 0.2), dvec2(0.9, 0.8), dvec2(0.5, 0.4)] {
            let to_point = SLANTED.at(along) - from;
            let direction = to_point.normalize();
            let hit = SLANTED.intersect_plane(from, direction).unwrap();
            assert!(hit.is_hit());
            assert!((hit.distance - to_point.length()).abs() < 1e-14);
            assert!((hit.cosine - direction.z).abs() < 1e-14);
            let half = FlatShape {
                is_triangle: true,
                ..SLANTED
            };
            let half = half.intersect_plane(from, direction).unwrap();
            assert_eq!(half.is_hit(), along.x + along.y < 1.0);
        }
    }

    #[test]
    fn clearance_is_the_distance_from_the_edges() {
        // One below the upper edge, whose y is 3. The largest coordinate is 8.
        let clearance = |x, y| {
            let hit = SLANTED.intersect_plane(dvec3(x, y, 5.0), DVec3::NEG_Z);
            hit.unwrap().clearance
        };
        assert!((clearance(5.0, 2.0) - 1.0 / 8.0).abs() < 1e-15);
        assert!((clearance(6.0, 3.5) + 0.5 / 8.0).abs() < 1e-15);
    }

    #[test]
    fn planes_behind_or_parallel_are_not_hit() {
        let behind = SLANTED.intersect_plane(dvec3(5.0, 2.0, 1.0), DVec3::NEG_Z);
        let behind = behind.unwrap();
        assert!(!behind.is_hit() && behind.margin() == 1.0 / 8.0);
        assert!(
            SLANTED
                .intersect_plane(dvec3(5.0, 2.0, 1.0), DVec3::X)
                .is_none()
        );
    }
}
