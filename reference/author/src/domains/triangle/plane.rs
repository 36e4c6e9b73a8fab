//! The point where a ray crosses a triangle's plane, and its accuracy in single precision.

use glam::DVec3;
use protocol::{Shape, Vertex};

use super::aspects::uv_extent;
use crate::domains::fields::{EPSILON, FURTHEST, FURTHEST_SIZES};
use crate::domains::shape::ShapeCall;
use crate::oracle::bbox::Bounds;
use crate::oracle::{Ray64, scan, triangle};

/// The point where a call's ray crosses the plane of the triangle.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// The ray.
    pub ray64: Ray64,
    /// The distance along the ray, which is negative if the ray leads away from the plane.
    pub distance: f64,
    /// The weights of the corners.
    pub weights: [f64; 3],
    /// The dot product of the ray's direction and the normalized normal (p1 − p0) × (p2 − p0).
    /// Negative if the ray comes from the front.
    pub slope: f64,
    /// The length of the sum of the corners' normals, each multiplied by its weight.
    pub(super) normal_length: f64,
    /// The largest difference between the texture coordinates of two corners.
    uv_extent: f64,
    /// The distance of the ray's start from the triangle, as a multiple of the triangle's size.
    start: f64,
    /// The smallest altitude.
    altitude: f64,
    /// The longest side.
    longest: f64,
    /// Half of the longest side of the triangle's box.
    pub(super) size: f64,
    /// The largest coordinate of the ray and the triangle.
    pub(super) coordinates: f64,
}

impl Plane {
    /// Returns the point where a call's ray crosses the plane, or `None` if the ray is parallel to
    /// it.
    pub fn of(call: &ShapeCall) -> Option<Plane> {
        let corners @ [p0, p1, p2] = scan::corners(&call.shape)?;
        let ray64 = Ray64::from(&call.ray);
        let crossing = triangle::intersect_plane(&ray64, corners)?;
        let normal = (p1 - p0).cross(p2 - p0);
        let (longest, altitude) = longest_side_and_altitude(corners);
        let points = corners.into_iter().chain([ray64.origin]);
        let weighted = corner_normals(&call.shape).map(|[n0, n1, n2]| {
            let [w0, w1, w2] = crossing.weights;
            w0 * n0 + w1 * n1 + w2 * n2
        });
        let bounds = Bounds::around(corners);
        let size = bounds.half_side();
        let beside = ray64.origin - ray64.origin.clamp(bounds.min, bounds.max);
        Some(Plane {
            uv_extent: vertices(&call.shape)
                .map_or(1.0, |vertices| uv_extent(vertices.map(|vertex| vertex.uv))),
            normal_length: weighted.map_or(1.0, DVec3::length),
            start: beside.length() / size,
            ray64,
            distance: crossing.distance,
            weights: crossing.weights,
            slope: normal.normalize().dot(ray64.dir),
            altitude,
            longest,
            size,
            coordinates: points
                .map(|point| point.abs().max_element())
                .fold(0.0, f64::max),
        })
    }

    /// Returns the smallest weight, which is negative outside the triangle.
    pub fn least_weight(&self) -> f64 {
        self.weights.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Returns whether the range of the ray is from 0 to ∞.
    pub fn is_unlimited(&self) -> bool {
        self.ray64.min == 0.0 && self.ray64.max == f64::INFINITY
    }

    /// Returns whether the ray crosses the plane inside the triangle, regardless of the ray's
    /// range.
    pub fn is_inside(&self) -> bool {
        self.least_weight() >= 0.0
    }

    pub(super) fn is_hit(&self) -> bool {
        self.is_inside() && self.ray64.is_in_range(self.distance)
    }

    /// Returns whether all correct single-precision formulas agree on whether the triangle is hit.
    pub fn is_clear(&self) -> bool {
        /// The minimum distance from an edge, as a fraction of the altitude.
        const EDGE_MARGIN: f64 = 5e-4;
        /// The minimum cosine at which `EDGE_MARGIN` is enough.
        const EDGE_COSINE: f64 = 0.1;
        /// The minimum difference between a distance and an end of the range, as a multiple of the
        /// triangle's size.
        const END_MARGIN: f64 = 0.0101;
        // At smaller cosines, errors grow.
        let margin = EDGE_MARGIN * (EDGE_COSINE / self.slope.abs()).max(1.0);
        let margin = margin.max(4.0 * self.weight_error());
        if self.start > FURTHEST_SIZES || self.coordinates > FURTHEST {
            return false;
        }
        if self.slope.abs() < 3.5e-3 || self.least_weight().abs() < margin {
            return false;
        }
        let margin = (END_MARGIN * self.size).max(4.0 * self.distance_error());
        let mut ends = [self.ray64.min, self.ray64.max].into_iter();
        !self.is_inside() || ends.all(|end| (self.distance - end).abs() >= margin)
    }

    /// Returns whether every correct single-precision formula computes `quantity` well within its
    /// tolerance.
    pub fn is_exact(&self, quantity: &str) -> bool {
        /// The largest fraction of a tolerance that errors may use up.
        const PART: f64 = 0.5;
        if !self.is_hit() {
            return true;
        }
        let scale = self.coordinates.max(self.distance);
        match quantity {
            "distance" | "position" => self.distance_error() <= PART * 1e-4 * scale,
            "normal" => {
                /// The minimum length of a sum of normals whose direction is accurate.
                const LEAST: f64 = 0.25;
                let error = 2.0 * self.weight_error() / self.normal_length;
                self.normal_length > LEAST && error <= PART * 1e-3
            }
            "uv" => self.uv_extent.max(5.0) * self.weight_error() <= PART * 2e-3,
            _ => true,
        }
    }

    /// Returns a bound on the error of the distance if it is computed in single precision by a
    /// common formula, such as (n · p0 − n · origin) / (n · direction).
    fn distance_error(&self) -> f64 {
        let slenderness = self.longest / self.altitude;
        let lengths = self.coordinates + self.distance.abs();
        let determinant = slenderness * (self.distance.abs() + self.longest);
        1.5 * EPSILON * (lengths + determinant) / self.slope.abs()
    }

    /// Returns a bound on the error of a weight that a common formula computes in single precision.
    /// Some formulas divide by the square of the area.
    fn weight_error(&self) -> f64 {
        let position = 2.0 * self.distance_error() + 4.0 * EPSILON * self.coordinates;
        position / self.altitude + 4.0 * EPSILON * (self.longest / self.altitude).powi(2)
    }
}

/// Returns the length of the longest side and the altitude above it.
pub(super) fn longest_side_and_altitude([p0, p1, p2]: [DVec3; 3]) -> (f64, f64) {
    let longest = p0.distance(p1).max(p1.distance(p2)).max(p2.distance(p0));
    (longest, (p1 - p0).cross(p2 - p0).length() / longest)
}

/// Returns a triangle's vertices, or `None` if the shape has only corners or is a sphere.
pub(super) fn vertices(shape: &Shape) -> Option<[Vertex; 3]> {
    match shape {
        Shape::Triangle { vertices, .. } => Some(*vertices),
        Shape::FlatTriangle { .. } | Shape::Sphere { .. } => None,
    }
}

/// Returns the normals of a triangle's corners, or `None` if the triangle doesn't have any.
pub(super) fn corner_normals(shape: &Shape) -> Option<[DVec3; 3]> {
    Some(vertices(shape)?.map(|vertex| vertex.normal.as_dvec3()))
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use protocol::Ray;

    use super::*;
    use crate::domains::Call;

    #[test]
    fn edges_and_ends_of_ranges_are_not_clear() {
        let corner =
            |x: f32, y: f32| Vertex::new(glam::vec3(x, y, -5.0), glam::Vec3::Z, Vec2::ZERO);
        let shape = Shape::Triangle {
            vertices: [corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0)],
            shape: 0,
        };
        let is_clear = |x: f32, max: f32| {
            let ray = Ray::new(glam::vec3(x, -0.5, 0.0), glam::Vec3::NEG_Z).within(0.0, max);
            Plane::of(&ShapeCall::new(shape, ray))
                .expect("a triangle")
                .is_clear()
        };
        assert!(is_clear(-0.9, 9.0) && is_clear(-0.998, 9.0) && is_clear(-1.002, 9.0));
        assert!(!is_clear(-0.9999, 9.0) && !is_clear(-1.0001, 9.0));
        assert!(!is_clear(-0.9, 5.01) && is_clear(-0.9, 4.9));
    }
}
