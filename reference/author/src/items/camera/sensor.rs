//! Items about how the film maps to the sensor.

use glam::{UVec2, uvec2};
use judging::exam::ExamQuestion;

use super::{camera, direction_question, middle_of, middle_row};
use crate::domains::camera::{ASPECT_RATIOS, FIELDS_OF_VIEW, drawn};
use crate::items::{Declaration, groups};
use crate::seed::Rng;

/// Returns an odd size for a film, so that it has a middle row.
fn odd_size(rng: &mut Rng, min: u32, max: u32) -> u32 {
    2 * rng.integer(min / 2, max / 2) + 1
}

/// Returns the aspect ratio of a film with square pixels.
fn aspect_of(film: UVec2) -> f64 {
    f64::from(film.x) / f64::from(film.y)
}

pub(in crate::items) const CORNERS: Declaration = Declaration {
    id: "camera.corners",
    title: "the film's corners map to the sensor's corners, and its centre to (0, 0, −1)",
    look: "The sensor spans −1 to 1 in x and y, at z = −1. Work out one position by hand: (pixel + \
        offset) / film runs from 0 to 1.",
    section: "camera.md#derivation",
    tests: &["Returns the ray that…", "The sensor is the…"],
    questions: corners,
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

fn corners(rng: &mut Rng) -> Vec<ExamQuestion> {
    // Only a film with an odd size has a pixel in its middle.
    let (small, even) = (odd_size(rng, 3, 9), 2 * rng.integer(3, 8));
    let sizes = [small, even, odd_size(rng, 11, 17)];
    // tan 45° = 1, so the sensor is 2 × 2.
    let question = |n: u32| {
        let film = UVec2::splat(n);
        let end = n - 1;
        let corners = [(0, 0), (end, 0), (0, end), (end, end), (n / 2, n / 2)];
        let sample = |(x, y)| middle_of(x, y);
        direction_question(camera(90.0, 1.0, film), corners.map(sample).to_vec())
    };
    sizes.map(question).to_vec()
}

pub(super) const FIELD_OF_VIEW: Declaration = Declaration {
    id: "camera.field_of_view",
    points: 2,
    title: "the sensor's height is 2·tan(fov/2)",
    look: "vertical_fov is the full angle, in degrees. Draw the triangle from the camera to the \
           centre and the upper edge of the sensor: what is its angle at the camera?",
    section: "camera.md#half-the-angle-and-twice-the-tangent",
    tests: &["The sensor is the…"],
    questions: |rng| {
        let film = UVec2::splat(odd_size(rng, 9, 31));
        let question = |part| {
            let field_of_view = drawn(part, rng);
            direction_question(camera(field_of_view, 1.0, film), middle_row(film))
        };
        FIELDS_OF_VIEW.map(question).to_vec()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const ASPECT_RATIO: Declaration = Declaration {
    id: "camera.aspect_ratio",
    title: "the sensor's width is its height times the aspect ratio",
    look: "vertical_fov gives the sensor's height, and the width is aspect_ratio · height. The \
        film has film.x columns and film.y rows: for a point (x, y) on the film, x / film.x is a \
        fraction of the width, and y / film.y is a fraction of the height.",
    section: "camera.md#from-pixel-to-sensor",
    tests: &["The sensor is the…"],
    questions: |rng| {
        let films = [
            uvec2(rng.integer(13, 19), odd_size(rng, 7, 11)),
            uvec2(rng.integer(7, 10), odd_size(rng, 13, 17)),
            uvec2(rng.integer(18, 24), odd_size(rng, 5, 7)),
            uvec2(rng.integer(25, 30), odd_size(rng, 3, 5)),
            uvec2(30, 3),
            uvec2(rng.integer(3, 5), odd_size(rng, 23, 29)),
            uvec2(1, 10),
        ];
        let question = |film: UVec2| {
            let fov = rng.uniform(50.0, 70.0);
            direction_question(camera(fov, aspect_of(film), film), middle_row(film))
        };
        films.map(question).to_vec()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const OTHER_ASPECT: Declaration = Declaration {
    id: "camera.other_aspect",
    title: "the sensor's shape comes from aspect_ratio, not from the film",
    look: "Pixels don't have to be square: the film only determines how many pixels the sensor is divided into.",
    section: "camera.md#the-aspect-ratio-is-not-that-of-the-film",
    tests: &["The sensor is the…"],
    questions: |rng| {
        let films = [uvec2(9, 9), uvec2(16, 5), uvec2(5, 9)];
        let questions = films.into_iter().zip([[4, 1], [2, 6], [3, 5]]);
        let questions = questions.map(|(film, others)| {
            let field_of_view = if film.x == film.y {
                90.0
            } else {
                rng.uniform(60.0, 80.0)
            };
            others.map(|other| {
                let camera = camera(field_of_view, drawn(ASPECT_RATIOS[other], rng), film);
                direction_question(camera, middle_row(film))
            })
        });
        questions.flatten().collect()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const FILM: Declaration = Declaration {
    id: "camera.film",
    title: "x is divided by the film's width, and y by its height",
    look: "The film and the sensor don't have to be square. (pixel.x + offset.x) / film.x is a \
           fraction of the sensor's width, and (pixel.y + offset.y) / film.y is a fraction of its \
           height.",
    section: "camera.md#each-axis-has-its-own-size",
    tests: &["The film's pixels…", "`pixel` and `film`…"],
    questions: |rng| {
        let films = [
            uvec2(odd_size(rng, 13, 21), odd_size(rng, 3, 7)),
            uvec2(odd_size(rng, 3, 7), odd_size(rng, 13, 21)),
            uvec2(odd_size(rng, 5, 9), 1),
            uvec2(1, odd_size(rng, 5, 9)),
        ];
        let question = |film: UVec2| {
            let columns = (0..film.y).map(|y| middle_of(film.x / 2, y));
            let samples = middle_row(film).into_iter().chain(columns);
            direction_question(camera(90.0, aspect_of(film), film), samples)
        };
        films.map(question).to_vec()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};

pub(super) const BOTTOM_LEFT: Declaration = Declaration {
    id: "camera.bottom_left",
    title: "pixel (0, 0) is at the bottom left",
    look: "y points up on the film, as it does in space: rays with a small y point down, and rays \
        with a small x point left.",
    section: "camera.md#row-zero-is-at-the-bottom",
    tests: &["The film's pixels…"],
    questions: |rng| {
        let sizes = [rng.integer(6, 9), rng.integer(10, 15)];
        let question = |n: u32| {
            let film = UVec2::splat(n);
            let samples = (0..n).map(|i| middle_of(i, i / 2));
            direction_question(camera(90.0, 1.0, film), samples)
        };
        sizes.map(question).to_vec()
    },
    ..Declaration::in_group(groups::CAMERA_RAYS)
};
