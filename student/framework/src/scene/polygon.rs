//! Flat, convex outlines: walls, floors, lamps.

use glam::{Vec2, Vec3, vec2};
use protocol::{Shape, Vertex};
use serde::Deserialize;

use super::number;

/// How far a point may be from the plane of the others, as a share of the polygon's size: room for
/// rounded coordinates, not for a bend that can be seen.
const FLATNESS_TOLERANCE: f32 = 1e-3;

/// A flat, convex outline, counter-clockwise around its normal.
#[derive(Deserialize)]
#[serde(try_from = "PolygonInFile")]
pub(super) struct Polygon {
    vertices: Vec<Vertex>,
    pub(super) material: String,
}

impl Polygon {
    /// A fan of triangles from the first point.
    pub(super) fn shapes(&self, material: u32) -> impl Iterator<Item = Shape> {
        let (first, others) = self.vertices.split_first().expect("it has three or more");
        others.windows(2).map(move |pair| Shape::Triangle {
            vertices: [*first, pair[0], pair[1]],
            material,
        })
    }
}

/// A `polygon` in a scene file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PolygonInFile {
    #[serde(deserialize_with = "number::triples")]
    points: Vec<Vec3>,
    /// One for each point. Without it, u runs along the first side and v across it, each from 0
    /// to 1 over the whole polygon.
    uv: Option<Vec<[f32; 2]>>,
    material: String,
}

/// What is wrong with an outline.
#[derive(Debug, thiserror::Error)]
enum PolygonError {
    #[error("a polygon of {0} points: it takes three or more")]
    TooFew(usize),
    #[error("a polygon without area: its points are in line")]
    NoArea,
    #[error("point {0} is out of the plane of the others: split the polygon")]
    NotFlat(usize),
    #[error("the outline turns the other way at point {0}: split the polygon into convex ones")]
    NotConvex(usize),
    #[error("{uv} pairs in `uv` for {points} points: one for each")]
    Uv { uv: usize, points: usize },
}

impl TryFrom<PolygonInFile> for Polygon {
    type Error = PolygonError;

    fn try_from(file: PolygonInFile) -> Result<Self, PolygonError> {
        let PolygonInFile {
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

/// The normal of a flat, convex outline.
fn normal(points: &[Vec3]) -> Result<Vec3, PolygonError> {
    let first = points[0];
    let size = points.iter().map(|p| p.distance(first)).fold(0.0, f32::max);
    // Newell's sum: twice the area, along the normal, of however many points.
    let twice_area: Vec3 = sides(points)
        .map(|(a, b)| (a - first).cross(b - first))
        .sum();
    if twice_area.length() <= 1e-6 * size * size {
        return Err(PolygonError::NoArea);
    }
    let normal = twice_area.normalize();

    let off_plane = |p: &Vec3| (*p - first).dot(normal).abs() > FLATNESS_TOLERANCE * size;
    if let Some(place) = points.iter().position(off_plane) {
        return Err(PolygonError::NotFlat(place + 1));
    }
    let next = points.iter().cycle().skip(2);
    for (place, ((a, b), c)) in sides(points).zip(next).enumerate() {
        if (b - a).cross(*c - b).dot(normal) < -1e-6 * size * size {
            return Err(PolygonError::NotConvex((place + 1) % points.len() + 1));
        }
    }
    Ok(normal)
}

/// Each point with the one that follows.
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
    let places = || points.iter().map(flat);
    let low = places().reduce(Vec2::min).unwrap_or(Vec2::ZERO);
    let high = places().reduce(Vec2::max).unwrap_or(Vec2::ONE);
    places().map(|place| (place - low) / (high - low)).collect()
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
        let square = polygon("[[0,0,5], [2,0,5], [2,2,5], [0,2,5]]").expect("it is flat");
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
        let problem = |points| polygon(points).err().expect("it is refused");
        assert!(problem("[[0,0,0], [1,0,0]]").contains("a polygon of 2 points"));
        assert!(problem("[[0,0,0], [1,0,0], [2,0,0]]").contains("in line"));
        assert!(problem("[[0,0,0], [1,0,0], [1,1,1], [0,1,0]]").contains("out of the plane"));
        let arrow = problem("[[0,0,0], [2,0,0], [0.5,0.5,0], [0,2,0]]");
        assert!(arrow.contains("at point 3"), "{arrow}");
    }
}
