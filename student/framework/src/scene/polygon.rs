//! Flat polygons, such as walls, floors and lights.

use glam::{DVec3, Vec2, Vec3, vec2};
use protocol::Vertex;

use super::error::SceneError;
use super::triangulate::{fan, triangulate};
use super::value::{Object, Value};

/// The maximum distance of a point from the plane of the polygon, relative to the polygon's size.
/// It is large enough to allow for rounded coordinates, but too small to allow a visible bend.
const FLATNESS_TOLERANCE: f64 = 1e-3;

/// Reads a polygon's entry and splits the polygon into triangles.
pub(super) fn read(keys: &Object) -> Result<Vec<[Vertex; 3]>, SceneError> {
    let list = keys.value("points")?;
    let points = list.list(Value::point)?;
    let (normal, triangles) = split(&points).map_err(|message| list.error(message))?;
    let uv = keys.optional("uv", |list| {
        let pair = |value: &Value| value.numbers("two finite numbers, u and v", |_| true);
        let uv = list.list(|value| pair(value).map(Vec2::from_array))?;
        let (given, needed) = (uv.len(), points.len());
        if given == needed {
            return Ok(uv);
        }
        Err(list.error(format!(
            "`uv` has length {given} and `points` has length {needed}: give one uv for each point"
        )))
    })?;
    let uv = uv.unwrap_or_else(|| uv_along_the_first_side(&points, normal));
    let vertex = |i: usize| Vertex::new(points[i], normal, uv[i]);
    Ok(triangles
        .into_iter()
        .map(|corners| corners.map(vertex))
        .collect())
}

/// Returns the normal of a polygon and the indices of its triangles, or the reason it is
/// invalid.
fn split(points: &[Vec3]) -> Result<(Vec3, Vec<[usize; 3]>), String> {
    let count = points.len();
    if count < 3 {
        return Err(format!(
            "`points` has length {count}: a polygon needs at least 3 points"
        ));
    }
    // Use double precision, in which products of single-precision coordinates can't overflow.
    let points: Vec<DVec3> = points.iter().map(|point| point.as_dvec3()).collect();
    let size = points
        .iter()
        .map(|p| p.distance(points[0]))
        .fold(0.0, f64::max);
    let after = |index: usize| (index + 1) % count;
    let same = |&index: &usize| points[index].distance(points[after(index)]) <= 1e-6 * size;
    if let Some(index) = (0..count).find(same) {
        let (first, second) = (index + 1, after(index) + 1);
        return Err(format!(
            "`points` {first} and {second} are the same: remove one of them"
        ));
    }
    let smallest = 1e-6 * size * size;
    if fan(&points).all(|cross| cross.length() <= smallest) {
        return Err("all `points` are on one line, so the polygon has no area".to_owned());
    }
    let crosses =
        "the outline of `points` crosses itself: list the corners in order around the polygon";
    let sum: DVec3 = fan(&points).sum();
    if sum.length() <= smallest {
        return Err(crosses.to_owned());
    }
    let normal = sum.normalize();
    let off_plane = |p: &DVec3| (*p - points[0]).dot(normal).abs() > FLATNESS_TOLERANCE * size;
    if let Some(index) = points.iter().position(off_plane) {
        return Err(format!(
            "`points` are not in one plane: point {} is off the plane, so split the polygon",
            index + 1
        ));
    }
    let triangles = triangulate(&points).ok_or(crosses)?;
    Ok((normal.as_vec3(), triangles))
}

/// Returns the texture coordinates of the points: u runs along the first side and v perpendicular
/// to it, each from 0 to 1 over the whole polygon.
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

    fn polygon(points: &str) -> Result<Vec<[Vertex; 3]>, String> {
        let text = format!(r#"{{ "points": {points} }}"#);
        let value = Value::parse(&text).expect("the text is JSON");
        let keys = value.object(&["points", "uv"]).expect("the keys are known");
        read(&keys).map_err(|error| error.message)
    }

    #[test]
    fn a_square_of_any_size_becomes_two_triangles_with_the_whole_texture() {
        for size in ["1e-12", "2", "1e9"] {
            let points = format!("[[0,0,5], [{size},0,5], [{size},{size},5], [0,{size},5]]");
            let [first, second] = polygon(&points).expect("the polygon is valid")[..] else {
                panic!("a square is two triangles");
            };
            assert_eq!(
                first.map(|vertex| vertex.uv),
                [Vec2::ZERO, Vec2::X, Vec2::ONE]
            );
            assert_eq!(
                second.map(|vertex| vertex.uv),
                [Vec2::ZERO, Vec2::ONE, Vec2::Y]
            );
            assert_eq!(first.map(|vertex| vertex.normal), [Vec3::Z; 3]);
        }
    }

    #[test]
    fn a_concave_polygon_is_split_inside_its_outline() {
        let arrow = polygon("[[0,0,0], [2,0,0], [0.5,0.5,0], [0,2,0]]");
        let arrow = arrow.expect("the polygon is valid");
        assert_eq!(arrow.len(), 2);
        let notch = Vec3::new(0.5, 0.5, 0.0);
        assert!(
            arrow
                .iter()
                .all(|corners| corners.iter().any(|v| v.position == notch))
        );
    }

    #[test]
    fn rejects_an_invalid_outline() {
        for (points, expected) in [
            ("[[0,0,0], [1,0,0]]", "`points` has length 2"),
            ("[[0,0,0], [1,0,0], [2,0,0]]", "are on one line"),
            ("[[0,0,0], [1,0,0], [1,1,1], [0,1,0]]", "not in one plane"),
            (
                "[[0,0,0], [1,0,0], [1,0,0], [0,1,0]]",
                "`points` 2 and 3 are the same",
            ),
            (
                "[[0,0,0], [1,0,0], [0,1,0], [0,0,0]]",
                "`points` 4 and 1 are the same",
            ),
            ("[[0,0,0], [1,1,0], [1,0,0], [0,1,0]]", "crosses itself"),
            ("[[0,0,0], [3,3,0], [3,0,0], [0,1,0]]", "crosses itself"),
        ] {
            let message = polygon(points).expect_err("the polygon is invalid");
            assert!(message.contains(expected), "{message}");
        }
    }
}
