//! Flat, convex polygons, such as walls, floors and lights.

use glam::{DVec3, Vec2, Vec3, vec2};
use protocol::{Shape, Vertex};
use serde::Deserialize;

use super::number;

/// The maximum distance of a point from the plane of the polygon, relative to the polygon's size.
/// It is large enough to allow rounded coordinates, but too small to allow a visible bend.
const FLATNESS_TOLERANCE: f64 = 1e-3;

/// A flat, convex polygon, counter-clockwise around its normal.
#[derive(Deserialize)]
#[serde(try_from = "PolygonEntry")]
pub(super) struct Polygon {
    vertices: Vec<Vertex>,
    pub(super) material: String,
}

impl Polygon {
    /// Returns a triangle fan around the first point. The triangles are numbered from `number`.
    pub(super) fn shapes(&self, number: u32) -> impl Iterator<Item = Shape> {
        let (first, others) = self
            .vertices
            .split_first()
            .expect("a polygon has three or more vertices");
        let fan = others.windows(2).zip(number..);
        fan.map(|(pair, material)| Shape::Triangle {
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
    #[serde(default, deserialize_with = "number::optional_pairs")]
    uv: Option<Vec<Vec2>>,
    material: String,
}

/// An error in a polygon.
#[derive(Debug, thiserror::Error)]
enum PolygonError {
    #[error("`points` has length {0}: a polygon needs 3 or more points")]
    TooFew(usize),
    #[error("`points` {0} and {1} are the same: remove one of them")]
    SamePoint(usize, usize),
    #[error("`points` are on a line, so the polygon has no area")]
    NoArea,
    #[error("`points` are not in a plane: point {0} is off it, so split the polygon")]
    NotFlat(usize),
    #[error("`points` are not convex at point {0}: split the polygon into convex ones")]
    NotConvex(usize),
    #[error("the outline of `points` crosses itself: list the corners in order, all around")]
    SelfCrossing,
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
        let uv = uv.unwrap_or_else(|| uv_along_the_first_side(&points, normal));
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
    // In double precision, in which no product of single-precision coordinates overflows.
    let points: Vec<DVec3> = points.iter().map(|point| point.as_dvec3()).collect();
    let first = points[0];
    let size = points.iter().map(|p| p.distance(first)).fold(0.0, f64::max);
    let after = |index: usize| (index + 1) % points.len();
    let same = |&index: &usize| points[index].distance(points[after(index)]) <= 1e-6 * size;
    if let Some(index) = (0..points.len()).find(same) {
        return Err(PolygonError::SamePoint(index + 1, after(index) + 1));
    }
    // Twice the area of the triangle with these corners, along its normal.
    let corner = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - b);
    let smallest = 1e-6 * size * size;
    if (1..points.len() - 1).all(|i| corner(first, points[i], points[i + 1]).length() <= smallest) {
        return Err(PolygonError::NoArea);
    }
    // Newell's method: the sum is along the normal, and its length is twice the area.
    let twice_area: DVec3 = (1..points.len() - 1)
        .map(|i| corner(first, points[i], points[i + 1]))
        .sum();
    if twice_area.length() <= smallest {
        return Err(PolygonError::SelfCrossing);
    }
    let normal = twice_area.normalize();

    let off_plane = |p: &DVec3| (*p - first).dot(normal).abs() > FLATNESS_TOLERANCE * size;
    if let Some(index) = points.iter().position(off_plane) {
        return Err(PolygonError::NotFlat(index + 1));
    }
    let turns_back = |a, b, c| corner(a, b, c).dot(normal) < -smallest;
    for (index, &point) in points.iter().enumerate() {
        let middle = after(index);
        if turns_back(point, points[middle], points[after(middle)]) {
            return Err(PolygonError::NotConvex(middle + 1));
        }
    }
    // Each corner of a star such as a pentagram turns the same way, but its fan of triangles does
    // not.
    if (1..points.len() - 1).any(|i| turns_back(first, points[i], points[i + 1])) {
        return Err(PolygonError::SelfCrossing);
    }
    Ok(normal.as_vec3())
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
        let numbers: Vec<u32> = square.shapes(3).map(|shape| shape.material()).collect();
        assert_eq!(numbers, [3, 4]);
    }

    #[test]
    fn rejects_an_invalid_outline() {
        let problem = |points| polygon(points).err().expect("the polygon is invalid");
        assert!(problem("[[0,0,0], [1,0,0]]").contains("`points` has length 2"));
        assert!(problem("[[0,0,0], [1,0,0], [2,0,0]]").contains("are on a line"));
        assert!(problem("[[0,0,0], [1,0,0], [1,1,1], [0,1,0]]").contains("not in a plane"));
        let arrow = problem("[[0,0,0], [2,0,0], [0.5,0.5,0], [0,2,0]]");
        assert!(arrow.contains("at point 3"), "{arrow}");
        let twice = problem("[[0,0,0], [1,0,0], [1,0,0], [0,1,0]]");
        assert!(twice.contains("`points` 2 and 3 are the same"), "{twice}");
        let closed = problem("[[0,0,0], [1,0,0], [0,1,0], [0,0,0]]");
        assert!(closed.contains("`points` 4 and 1 are the same"), "{closed}");
    }

    #[test]
    fn rejects_an_outline_that_crosses_itself() {
        let bow_tie = "[[0,0,0], [1,1,0], [1,0,0], [0,1,0]]";
        let pentagram = "[[0,1,0], [0.588,-0.809,0], [-0.951,0.309,0], [0.951,0.309,0], \
                         [-0.588,-0.809,0]]";
        let uneven = "[[0,0,0], [3,3,0], [3,0,0], [0,1,0]]";
        for points in [bow_tie, pentagram, uneven] {
            let message = polygon(points).err().expect("the polygon is invalid");
            let names_it = message.contains("crosses itself") || message.contains("not convex");
            assert!(names_it, "{message}");
        }
    }

    #[test]
    fn large_and_small_polygons_are_valid_and_have_finite_texture_coordinates() {
        for size in ["1e-12", "1e9"] {
            let points = format!("[[0,0,0], [{size},0,0], [{size},{size},0], [0,{size},0]]");
            let square = polygon(&points).expect("the polygon is valid");
            let vertices = square.vertices.iter();
            let uvs: Vec<Vec2> = vertices.map(|vertex| vertex.uv).collect();
            assert_eq!(uvs, [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]);
        }
    }
}
