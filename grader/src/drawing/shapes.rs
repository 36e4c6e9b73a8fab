//! A ray among shapes: the one that matters is drawn.

use glam::DVec3;
use protocol::Shape;

use super::hit_comparison::{HitAnswer, HitComparison};
use super::{Drawing, sphere, triangle};

/// The drawing of the shape that the ray should meet, or does by the answer, or passes by.
pub(super) fn draw(encounter: &HitComparison, shapes: &[Shape]) -> Option<Drawing> {
    let told = match (encounter.wanted, encounter.got) {
        (Some(met), _) | (None, HitAnswer::Hit(met)) => Some(met.position),
        (None, HitAnswer::Miss | HitAnswer::NoAnswer) => None,
    };
    let misfit = |shape: &&Shape| match told {
        Some(point) => distance_to_surface(shape, point),
        None => distance_to_line(shape, encounter),
    };
    let shape = shapes
        .iter()
        .min_by(|a, b| misfit(a).total_cmp(&misfit(b)))?;
    match *shape {
        Shape::Sphere { center, radius, .. } => {
            let (center, radius) = (center.as_dvec3(), f64::from(radius));
            (center.is_finite() && radius.is_finite() && radius > 0.0)
                .then(|| sphere::draw(encounter, center, radius))
        }
        Shape::Triangle { vertices, .. } => Some(triangle::draw(encounter, &vertices)),
        Shape::FlatTriangle { corners, .. } => {
            let vertices = Shape::flat_triangle_vertices(corners);
            Some(triangle::draw(encounter, &vertices))
        }
    }
}

/// About how far a point is from a surface.
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

/// About how far a shape's middle is from the line of the ray.
fn distance_to_line(shape: &Shape, encounter: &HitComparison) -> f64 {
    let middle = match *shape {
        Shape::Sphere { center, .. } => center.as_dvec3(),
        Shape::Triangle { .. } | Shape::FlatTriangle { .. } => {
            let [p0, p1, p2] = corners(shape);
            (p0 + p1 + p2) / 3.0
        }
    };
    let aside = middle - encounter.ray.origin.as_dvec3();
    aside.cross(encounter.dir()).length()
}

/// The corners of a triangle; all in the center of a sphere.
fn corners(shape: &Shape) -> [DVec3; 3] {
    match *shape {
        Shape::Triangle { vertices, .. } => vertices.map(|vertex| vertex.position.as_dvec3()),
        Shape::FlatTriangle { corners, .. } => corners.map(|corner| corner.as_dvec3()),
        Shape::Sphere { center, .. } => [center.as_dvec3(); 3],
    }
}
