//! Draws a ray and whichever of the shapes is relevant to it.

use glam::DVec3;
use protocol::Shape;

use super::hit_comparison::HitComparison;
use super::{Drawing, sphere, triangle};

/// Draws the shape of the expected hit. If no hit is expected, draws the shape of the submitted
/// hit. If there is no submitted hit either, draws the shape nearest to the ray.
pub(super) fn draw(comparison: &HitComparison, shapes: &[Shape]) -> Option<Drawing> {
    let hit = comparison.wanted.or(comparison.got_hit());
    let distance = |shape: &&Shape| match hit {
        Some(hit) => distance_to_surface(shape, hit.position.as_dvec3()),
        None => distance_to_line(shape, comparison),
    };
    let shape = shapes
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    match *shape {
        Shape::Sphere { center, radius, .. } => {
            let (center, radius) = (center.as_dvec3(), f64::from(radius));
            (center.is_finite() && radius.is_finite() && radius > 0.0)
                .then(|| sphere::draw(comparison, center, radius))
        }
        Shape::Triangle { vertices, .. } => Some(triangle::draw(comparison, &vertices)),
        Shape::FlatTriangle { corners, .. } => {
            let vertices = Shape::flat_triangle_vertices(corners);
            Some(triangle::draw(comparison, &vertices))
        }
    }
}

/// Returns the approximate distance from a point to the surface of a shape.
fn distance_to_surface(shape: &Shape, point: DVec3) -> f64 {
    match *shape {
        Shape::Sphere { center, radius, .. } => {
            (point.distance(center.as_dvec3()) - f64::from(radius)).abs()
        }
        Shape::Triangle { .. } | Shape::FlatTriangle { .. } => {
            let [p0, p1, p2] = corners(shape);
            let normal = (p1 - p0).cross(p2 - p0).normalize_or_zero();
            let (min, max) = (p0.min(p1).min(p2), p0.max(p1).max(p2));
            (point - p0).dot(normal).abs() + point.distance(point.clamp(min, max))
        }
    }
}

/// Returns the distance from a shape's centre to the ray's line.
fn distance_to_line(shape: &Shape, comparison: &HitComparison) -> f64 {
    let [p0, p1, p2] = corners(shape);
    let aside = (p0 + p1 + p2) / 3.0 - comparison.ray.origin.as_dvec3();
    aside.cross(comparison.dir()).length()
}

/// Returns the corners of a triangle or, for a sphere, its centre three times.
pub(super) fn corners(shape: &Shape) -> [DVec3; 3] {
    match *shape {
        Shape::Triangle { vertices, .. } => vertices.map(|vertex| vertex.position.as_dvec3()),
        Shape::FlatTriangle { corners, .. } => corners.map(|corner| corner.as_dvec3()),
        Shape::Sphere { center, .. } => [center.as_dvec3(); 3],
    }
}
