//! Items about the offset within the pixel, and about the ray itself.

use glam::{UVec2, uvec2, vec2};
use judging::exam::ExamQuestion;
use protocol::{Rows, Sample};

use super::{camera, camera_question, direction_question, middle_of, random_below};
use crate::items::{Declaration, groups};
use crate::seed::Rng;

fn random_offset(rng: &mut Rng) -> f32 {
    // The very ends are avoided, because 1 is not a valid offset.
    rng.uniform(0.02, 0.98) as f32
}

pub(super) const OFFSET: Declaration = Declaration {
    id: "camera.offset",
    points: 2,
    title: "the offset moves the ray within its pixel",
    look: "Pixel (x, y) with its offset is the point (x + offset.x, y + offset.y) of the film, \
           measured in pixels. Each component is used as it is given, on its own axis.",
    section: "camera.md#the-offset-is-measured-in-pixels",
    questions: |rng| {
        let question = |width: u32| {
            let samples = (0..24).map(|_| Sample {
                pixel: uvec2(random_below(rng, width), 0),
                offset: vec2(random_offset(rng), 0.5),
            });
            let camera = camera(50.0, f64::from(width), uvec2(width, 1));
            direction_question(camera, samples)
        };
        [1, 3, 4].map(question).to_vec()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const OFFSET_AXES: Declaration = Declaration {
    id: "camera.offset_axes",
    title: "the offset's x moves the ray to the right, and its y moves it up",
    look: "The two components are independent, and each belongs to its own axis.",
    section: "camera.md#the-offset-is-measured-in-pixels",
    questions: |rng| {
        let samples = (0..24).map(|i| {
            let small = rng.uniform(0.05, 0.25) as f32;
            let large = rng.uniform(0.6, 0.95) as f32;
            Sample {
                pixel: uvec2(0, 0),
                offset: if i % 2 == 0 {
                    vec2(small, large)
                } else {
                    vec2(large, small)
                },
            }
        });
        vec![direction_question(camera(90.0, 1.0, UVec2::ONE), samples)]
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const LARGE_FILM: Declaration = Declaration {
    id: "camera.large_film",
    title: "everything works together on a large film",
    look: "The film has 3840 columns and 2160 rows. Work out one position by hand: pixel + offset, \
           divided by these numbers in floating point, gives two fractions between 0 and 1.",
    section: "camera.md#integer-division-gives-zero",
    questions: |rng| {
        let film = uvec2(3840, 2160);
        let samples = (0..32).map(|_| Sample {
            pixel: uvec2(random_below(rng, film.x), random_below(rng, film.y)),
            offset: vec2(random_offset(rng), random_offset(rng)),
        });
        let samples: Vec<Sample> = samples.collect();
        let camera = camera(rng.uniform(35.0, 50.0), 16.0 / 9.0, film);
        vec![direction_question(camera, samples)]
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

/// Creates a question with very different directions, so that no constant answer passes an item
/// about length, origin or range.
fn spread_question(judged: &[&str], rng: &mut Rng) -> ExamQuestion {
    let film = UVec2::splat(rng.integer(7, 19));
    let samples = (0..16).map(|_| middle_of(random_below(rng, film.x), random_below(rng, film.y)));
    let samples = Rows::List(samples.collect());
    camera_question(judged, camera(90.0, 1.0, film), samples)
}

pub(super) const UNIT_LENGTH: Declaration = Declaration {
    id: "camera.unit_length",
    title: "the direction has length one",
    look: "Distances along a ray are measured in lengths of its direction. Ray::new normalises the \
           direction; filling in the fields yourself does not.",
    section: "camera.md#the-direction-has-length-one",
    questions: |rng| vec![spread_question(&["direction", "unit_direction"], rng)],
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const ORIGIN_AND_RANGE: Declaration = Declaration {
    id: "camera.origin_and_range",
    title: "the ray starts at the camera and has no end",
    look: "The camera is at (0, 0, 0), not on the sensor, and the range of the ray is from 0 to ∞.",
    section: "camera.md#the-ray-starts-at-the-camera",
    questions: |rng| {
        let judged = ["direction", "origin", "range"];
        vec![spread_question(&judged, rng)]
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const PICTURE: Declaration = Declaration {
    id: "camera.picture",
    points: 2,
    title: "every pixel of a picture looks in the right direction",
    look: "Five positions in each pixel are compared. See which of them are wrong: those at one \
           edge, in one half, or all except the middles of pixels?",
    section: "grading.md#reading-a-wrong-picture",
    questions: |rng| {
        let camera = camera(rng.uniform(45.0, 75.0), 1.5, uvec2(64, 64));
        let rows = Rows::Picture(camera.film);
        vec![camera_question(&["direction"], camera, rows)]
    },
    ..Declaration::ALONE
};
