//! Pictures of first hits.
//!
//! At an edge, correct submissions whose rays differ only in the last bit see different surfaces.
//! The key for a position is therefore a set of surfaces: those seen at the position itself, at
//! four neighbours, and at positions in between. The neighbours are so close that any mistake would
//! move an edge farther than that. The surfaces at positions in between are needed because the
//! depth changes so steeply near a sphere's silhouette that a correct depth may lie between the
//! depths at two neighbours.

use glam::{DVec3, UVec2, Vec2, Vec3, vec2};
use judging::exam::{ExamQuestion, Key, Surface};
use protocol::{ExamCamera, Geometry, Question, Rows, Sample, Shape, Table, every_pixel};

use crate::oracle::{Intersection, Ray64, scan};

/// The distance from a position to its neighbours along each axis, in pixels.
const NEIGHBOUR_DISTANCE: f32 = 5e-4;
/// The maximum depth of bisection between a position and a neighbour with a different surface.
const HALVINGS: u32 = 12;

/// Returns a camera at the origin that looks down −z with a field of view of 90 degrees.
///
/// Its numbers are exact in single precision, so shapes can be placed exactly behind the centres of
/// pixels.
pub fn camera_at_origin(pixels: u32) -> ExamCamera {
    camera_along(Vec3::ZERO, DVec3::NEG_Z, 1.0, pixels)
}

/// Returns a camera at `eye` that looks along `forward`, which must be a unit vector that isn't
/// parallel to y. At distance 1, the square film is 2 · `half` wide.
pub fn camera_along(eye: Vec3, forward: DVec3, half: f64, pixels: u32) -> ExamCamera {
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    ExamCamera {
        eye,
        forward: forward.as_vec3(),
        right: (half * right).as_vec3(),
        up: (half * up).as_vec3(),
        film: UVec2::splat(pixels),
    }
}

/// Creates a question that asks for a picture of these shapes. The expected picture is computed by
/// testing the shapes one by one, without a tree.
pub fn picture_question(camera: ExamCamera, shapes: Vec<Shape>) -> ExamQuestion {
    let key = first_hits_key(&camera, |ray64| scan::closest_hit(ray64, &shapes));
    let table = Table {
        subject: Geometry::List { shapes },
        rows: Rows::Picture(camera),
    };
    ExamQuestion::new(Question::Hit(table), key)
}

/// Returns the key for a picture. `sees` returns the first intersection of a ray.
pub fn first_hits_key(camera: &ExamCamera, sees: impl Fn(&Ray64) -> Option<Intersection>) -> Key {
    let surface_at = |sample: Sample, shift: Vec2| {
        let offset = sample.offset + shift;
        let ray64 = Ray64::from(&camera.ray(Sample { offset, ..sample }));
        sees(&ray64).map(|hit| hit.to_surface())
    };
    let mut hits = Vec::new();
    let mut alternatives: Vec<(u32, Option<Surface>)> = Vec::new();
    for (index, sample) in (0..).zip(every_pixel(camera.film)) {
        let here = surface_at(sample, Vec2::ZERO);
        let mut surfaces = vec![here];
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            let toward =
                |fraction: f32| surface_at(sample, fraction * NEIGHBOUR_DISTANCE * vec2(x, y));
            for surface in surfaces_between(&toward, (0.0, here), (1.0, toward(1.0)), HALVINGS) {
                if !surfaces
                    .iter()
                    .any(|other| is_judged_equal(other, &surface))
                {
                    surfaces.push(surface);
                }
            }
        }
        hits.push(surfaces[0]);
        alternatives.extend(surfaces[1..].iter().map(|&surface| (index, surface)));
    }
    Key::FirstHits { hits, alternatives }
}

/// Returns the surfaces seen between `start` and `end`, including the one at `end`. Bisects until
/// neighbouring surfaces are equal within the tolerances. At an edge this never happens, so the
/// depth of bisection is limited to `halvings`.
fn surfaces_between(
    toward: &impl Fn(f32) -> Option<Surface>,
    start: (f32, Option<Surface>),
    end: (f32, Option<Surface>),
    halvings: u32,
) -> Vec<Option<Surface>> {
    if halvings == 0 || is_judged_equal(&start.1, &end.1) {
        return vec![end.1];
    }
    let fraction = (start.0 + end.0) / 2.0;
    let middle = (fraction, toward(fraction));
    let mut surfaces = surfaces_between(toward, start, middle, halvings - 1);
    surfaces.extend(surfaces_between(toward, middle, end, halvings - 1));
    surfaces
}

/// Returns whether the judge accepts one surface in place of the other.
fn is_judged_equal(a: &Option<Surface>, b: &Option<Surface>) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => {
            let u_difference = (a.uv.x - b.uv.x).rem_euclid(1.0);
            (a.depth - b.depth).abs() <= 2e-4 * a.depth.max(1.0)
                && a.normal.distance(b.normal) <= 5e-3
                && u_difference.min(1.0 - u_difference) <= 2e-3
                && (a.uv.y - b.uv.y).abs() <= 2e-3
        }
        (None, Some(_)) | (Some(_), None) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Creates a question about a picture of a wall that ends exactly at the middle of the film.
    fn wall() -> ExamQuestion {
        let corner = |x: f32, y: f32| Vec3::new(x, y, -1.0);
        let wall = Shape::FlatTriangle {
            corners: [corner(0.0, -9.0), corner(0.0, 9.0), corner(9.0, 0.0)],
            shape: 0,
        };
        picture_question(camera_at_origin(9), vec![wall])
    }

    #[test]
    fn an_edge_accepts_both_sides_and_any_other_position_one_answer() {
        let Key::FirstHits { hits, alternatives } = wall().key else {
            unreachable!("the question is a picture")
        };
        assert_eq!(hits.len(), 9 * 9 * 5);
        // The centres of the nine pixels in the middle column are on the edge.
        let indices: Vec<u32> = alternatives.iter().map(|(index, _)| *index).collect();
        let expected: Vec<u32> = (0..9).map(|row| 5 * (9 * row + 4)).collect();
        assert_eq!(indices, expected);
        for (index, other) in alternatives {
            assert_ne!(other.is_some(), hits[index as usize].is_some());
        }
        assert!(hits[0].is_none() && hits[5 * 8].is_some());
    }
}
