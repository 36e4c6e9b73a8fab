//! Pictures of first hits.
//!
//! At an edge, honest answers differ in the last bit and so see different surfaces. Therefore a
//! position's key is the set of what is seen there, at four neighbours closer to it than any mistake
//! would move an edge, and on the way to these: the depth of a sphere's rim falls so steeply that
//! an honest answer may lie between those of two neighbours.

use glam::{DVec3, UVec2, Vec2, Vec3, vec2};
use grader::exam::{ExamQuestion, Key, Surface};
use protocol::{ExamCamera, Question, Rays, Sample, Shape, every_pixel};

use crate::oracle::scan::Scan;
use crate::oracle::{Intersection, Ray64};

/// How far the neighbours are, in pixels, across and up.
const NEIGHBOUR_DISTANCE: f32 = 5e-4;
/// How often the way to a neighbour that sees something else is halved.
const HALVINGS: u32 = 12;

/// A camera at the origin that looks down −z, with a view of 90 degrees.
///
/// Its numbers are so round that points in line with the middles of pixels are met exactly.
pub fn view_from_origin(pixels: u32) -> ExamCamera {
    view_along(Vec3::ZERO, DVec3::NEG_Z, 1.0, pixels)
}

/// A camera at `eye` that looks along `forward`, of length one and not along y; half of the square
/// film is `half` wide at distance one.
pub fn view_along(eye: Vec3, forward: DVec3, half: f64, pixels: u32) -> ExamCamera {
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

/// The question of what is seen of these shapes, each by its own `hit`.
pub fn picture_question(view: ExamCamera, shapes: Vec<Shape>) -> ExamQuestion {
    let scan = Scan::new(&shapes);
    let key = first_hits_key(&view, |beam| scan.closest_hit(beam));
    let rays = Rays::View(view);
    ExamQuestion::new(Question::Shapes { shapes, rays }, key)
}

/// The key to a picture of what a ray sees.
pub fn first_hits_key(view: &ExamCamera, sees: impl Fn(&Ray64) -> Option<Intersection>) -> Key {
    let seen = |sample: Sample, aside: Vec2| {
        let offset = sample.offset + aside;
        let beam = Ray64::from(&view.ray(Sample { offset, ..sample }));
        sees(&beam).map(|met| met.to_surface())
    };
    let mut hits = Vec::new();
    let mut also: Vec<(u32, Option<Surface>)> = Vec::new();
    for (place, sample) in (0..).zip(every_pixel(view.film)) {
        let here = seen(sample, Vec2::ZERO);
        let mut members = vec![here];
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            let toward = |part: f32| seen(sample, part * NEIGHBOUR_DISTANCE * vec2(x, y));
            for member in surfaces_between(&toward, (0.0, here), (1.0, toward(1.0)), HALVINGS) {
                if !members.iter().any(|other| is_judged_equal(other, &member)) {
                    members.push(member);
                }
            }
        }
        hits.push(members[0]);
        also.extend(members[1..].iter().map(|&member| (place, member)));
    }
    Key::FirstHits {
        hits,
        alternatives: also,
    }
}

/// What is seen on the way from one part of it to another, and at its end, in steps so small that
/// each is like the next: or else halved so often that they are at an edge.
fn surfaces_between(
    toward: &impl Fn(f32) -> Option<Surface>,
    start: (f32, Option<Surface>),
    end: (f32, Option<Surface>),
    halvings: u32,
) -> Vec<Option<Surface>> {
    if halvings == 0 || is_judged_equal(&start.1, &end.1) {
        return vec![end.1];
    }
    let part = (start.0 + end.0) / 2.0;
    let middle = (part, toward(part));
    let mut members = surfaces_between(toward, start, middle, halvings - 1);
    members.extend(surfaces_between(toward, middle, end, halvings - 1));
    members
}

/// Whether the judge takes one for the other.
fn is_judged_equal(a: &Option<Surface>, b: &Option<Surface>) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => {
            let across = (a.uv.x - b.uv.x).rem_euclid(1.0);
            (a.depth - b.depth).abs() <= 2e-4 * a.depth.max(1.0)
                && a.normal.distance(b.normal) <= 5e-3
                && across.min(1.0 - across) <= 2e-3
                && (a.uv.y - b.uv.y).abs() <= 2e-3
        }
        (None, Some(_)) | (Some(_), None) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall that ends exactly at the middle of the view.
    fn wall() -> ExamQuestion {
        let corner = |x: f32, y: f32| Vec3::new(x, y, -1.0);
        let wall = Shape::FlatTriangle {
            corners: [corner(0.0, -9.0), corner(0.0, 9.0), corner(9.0, 0.0)],
            material: 0,
        };
        picture_question(view_from_origin(9), vec![wall])
    }

    #[test]
    fn an_edge_accepts_both_sides_and_any_other_position_one_answer() {
        let Key::FirstHits {
            hits,
            alternatives: also,
        } = wall().key
        else {
            unreachable!("it is a picture")
        };
        assert_eq!(hits.len(), 9 * 9 * 5);
        // The middles of the nine pixels of the middle column lie on the edge.
        let places: Vec<u32> = also.iter().map(|(place, _)| *place).collect();
        let expected: Vec<u32> = (0..9).map(|row| 5 * (9 * row + 4)).collect();
        assert_eq!(places, expected);
        for (place, other) in also {
            assert_ne!(other.is_some(), hits[place as usize].is_some());
        }
        assert!(hits[0].is_none() && hits[5 * 8].is_some());
    }
}
