//! Flat, convex polygons, such as walls, floors and lights.

use glam::{Vec2, Vec3, vec2};
use protocol::{Shape, Vertex};
use serde::Deserialize;

use super::number;

/// The maximum distance of a point from the plane of the polygon, relative to the polygon's size.
/// It is large enough to allow rounded coordinates, but too small to allow a visible bend.
const FLATNESS_TOLERANCE: f32 = 1e-3;

/// A flat, convex polygon, counter-clockwise around its normal.
#[derive(Deserialize)]
#[serde(try_from = "PolygonEntry")]
pub(super) struct Polygon {
    vertices: Vec<Vertex>,
    pub(super) material: String,
}

impl Polygon {
    /// Returns a triangle fan around the first point.
    pub(super) fn shapes(&self, material: u32) -> impl Iterator<Item = Shape> {
        let (first, others) = self
            .vertices
            .split_first()
            .expect("a polygon has three or more vertices");
        others.windows(2).map(move |pair| Shape::Triangle {
            vertices: [*first, pair[0], pair[1]],
            material,
        })
    }
}

/// An entry `polygon` of a scene file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PolygonEntry {
    #[serde(deserialize_with = "number::triples")]
    points: Vec<Vec3>,
    /// The texture coordinates of each point. By default, u runs along the first side and v
    /// perpendicular to it, each from 0 to 1 over the whole polygon.
    uv: Option<Vec<[f32; 2]>>,
    material: String,
}

/// An error in a polygon.
#[derive(Debug, thiserror::Error)]
enum PolygonError {
    #[error("`points` has length {0}: a polygon needs 3 or more points")]
    TooFew(usize),
    #[error("the polygon has no area: its points are collinear")]
    NoArea,
    #[error("point {0} is not in the plane of the others: split the polygon")]
    NotFlat(usize),
    #[error("the polygon is not convex at point {0}: split it into convex polygons")]
    NotConvex(usize),
    #[error("`uv` has length {uv} and `points` has length {points}: give one uv for each point")]
    Uv { uv: usize, points: usize },
}

impl TryFrom<PolygonEntry> for Polygon {
    type Error = PolygonError;

    fn try_from(file: PolygonEntry) -> Result<Self, PolygonError> {
        let PolygonEntry {
            points,
            uv,
            material,
        } = file;
        if points.len() < 3 {
            return Err(PolygonError::TooFew(points.len()));
        }
        let normal = normal(&points)?;
        let uv = match uv {
            Some(uv) => uv.into_iter().map(Vec2::from_array).collect(),
            None => uv_along_the_first_side(&points, normal),
        };
        if uv.len() != points.len() {
            let (uv, points) = (uv.len(), points.len());
            return Err(PolygonError::Uv { uv, points });
        }
        let vertex = |(&position, uv)| Vertex::new(position, normal, uv);
        let vertices = points.iter().zip(uv).map(vertex).collect();
        Ok(Polygon { vertices, material })
    }
}

/// Returns the normal of a polygon, or an error if it is not flat and convex.
fn normal(points: &[Vec3]) -> Result<Vec3, PolygonError> {
    let first = points[0];
    let size = points.iter().map(|p| p.distance(first)).fold(0.0, f32::max);
    // Newell's method: the sum is along the normal, and its length is twice the area.
    let twice_area: Vec3 = sides(points)
        .map(|(a, b)| (a - first).cross(b - first))
        .sum();
    if twice_area.length() <= 1e-6 * size * size {
        return Err(PolygonError::NoArea);
    }
    let normal = twice_area.normalize();

    let off_plane = |p: &Vec3| (*p - first).dot(normal).abs() > FLATNESS_TOLERANCE * size;
    if let Some(index) = points.iter().position(off_plane) {
        return Err(PolygonError::NotFlat(index + 1));
    }
    let next = points.iter().cycle().skip(2);
    for (index, ((a, b), c)) in sides(points).zip(next).enumerate() {
        if (b - a).cross(*c - b).dot(normal) < -1e-6 * size * size {
            return Err(PolygonError::NotConvex((index + 1) % points.len() + 1));
        }
    }
    Ok(normal)
}

/// Returns each point together with the next, and the last point together with the first.
fn sides(points: &[Vec3]) -> impl Iterator<Item = (Vec3, Vec3)> {
    points
        .iter()
        .copied()
        .zip(points.iter().copied().cycle().skip(1))
}

fn uv_along_the_first_side(points: &[Vec3], normal: Vec3) -> Vec<Vec2> {
    let along = (points[1] - points[0]).normalize_or_zero();
    let across = normal.cross(along);
    let flat = |p: &Vec3| vec2((*p - points[0]).dot(along), (*p - points[0]).dot(across));
    let positions = || points.iter().map(flat);
    let low = positions().reduce(Vec2::min).unwrap_or(Vec2::ZERO);
    let high = positions().reduce(Vec2::max).unwrap_or(Vec2::ONE);
    positions()
        .map(|position| (position - low) / (high - low))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &str) -> Result<Polygon, String> {
        let text = format!(r#"{{ "points": {points}, "material": "white" }}"#);
        serde_json::from_str(&text).map_err(|error| error.to_string())
    }

    #[test]
    fn a_square_becomes_two_triangles_with_the_whole_texture() {
        let square = polygon("[[0,0,5], [2,0,5], [2,2,5], [0,2,5]]");
        let square = square.expect("the polygon is valid");
        let uv: Vec<Vec2> = square.vertices.iter().map(|vertex| vertex.uv).collect();
        assert_eq!(uv, [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]);
        assert!(
            square
                .vertices
                .iter()
                .all(|vertex| vertex.normal == Vec3::Z)
        );
        assert_eq!(square.shapes(3).count(), 2);
        assert!(square.shapes(3).all(|shape| shape.material() == 3));
    }

    #[test]
    fn rejects_an_invalid_outline() {
        let problem = |points| polygon(points).err().expect("the polygon is invalid");
        assert!(problem("[[0,0,0], [1,0,0]]").contains("`points` has length 2"));
        assert!(problem("[[0,0,0], [1,0,0], [2,0,0]]").contains("collinear"));
        assert!(problem("[[0,0,0], [1,0,0], [1,1,1], [0,1,0]]").contains("not in the plane"));
        let arrow = problem("[[0,0,0], [2,0,0], [0.5,0.5,0], [0,2,0]]");
        assert!(arrow.contains("at point 3"), "{arrow}");
    }
}
