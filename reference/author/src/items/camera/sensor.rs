//! Items about how the film maps to the sensor.

use glam::{UVec2, uvec2};
use judging::exam::Item;
use protocol::Sample;

use super::{MIDDLE, camera, direction_question, item, middle_row};
use crate::seed::Seed;

pub(super) fn corners(_: Seed) -> Item {
    // tan 45° = 1, so the sensor is 2 × 2.
    let question = |n: u32| {
        let film = UVec2::splat(n);
        let corners = [
            (0, 0),
            (n - 1, 0),
            (0, n - 1),
            (n - 1, n - 1),
            (n / 2, n / 2),
        ];
        let sample = |(x, y)| Sample {
            pixel: uvec2(x, y),
            offset: MIDDLE,
        };
        direction_question(camera(90.0, 1.0, film), corners.map(sample).to_vec())
    };
    item(
        "corners",
        1,
        [
            "the film's corners map to the sensor's corners, and its middle to (0, 0, −1)",
            "At 90 degrees the sensor reaches from −1 to 1, because half of its height is \
             tan(45°).",
        ],
        [3, 5, 64].map(question).to_vec(),
    )
}

pub(super) fn field_of_view(seed: Seed) -> Item {
    let mut rng = seed.rng("camera.field_of_view");
    let film = UVec2::splat(9);
    let question = |(from, to): (f64, f64)| {
        direction_question(camera(rng.uniform(from, to), 1.0, film), middle_row(film))
    };
    item(
        "field_of_view",
        2,
        [
            "the sensor's height is 2·tan(fov/2)",
            "vertical_fov is the full angle, in degrees. Draw the triangle from the camera to the \
             middle and the upper edge of the sensor: which angle is at the camera?",
        ],
        [(15.0, 25.0), (30.0, 50.0), (55.0, 80.0), (100.0, 125.0)]
            .map(question)
            .to_vec(),
    )
}

pub(super) fn aspect_ratio(_: Seed) -> Item {
    let question = |film: UVec2| {
        let aspect = f64::from(film.x) / f64::from(film.y);
        direction_question(camera(60.0, aspect, film), middle_row(film))
    };
    item(
        "aspect_ratio",
        1,
        [
            "the sensor's width is its height times the aspect ratio",
            "The vertical field of view gives the height; multiply it by the aspect ratio to get \
             the width.",
        ],
        [uvec2(15, 9), uvec2(9, 15), uvec2(21, 7)]
            .map(question)
            .to_vec(),
    )
}

pub(super) fn other_aspect(seed: Seed) -> Item {
    let mut rng = seed.rng("camera.other_aspect");
    let question = |(film, from, to)| {
        direction_question(camera(70.0, rng.uniform(from, to), film), middle_row(film))
    };
    item(
        "other_aspect",
        1,
        [
            "the sensor's shape comes from aspect_ratio, not from the film",
            "Pixels need not be square: the film only says how many pixels the sensor is divided \
             into.",
        ],
        [
            (uvec2(9, 9), 1.6, 2.4),
            (uvec2(16, 5), 0.5, 0.8),
            (uvec2(5, 9), 1.2, 1.8),
        ]
        .map(question)
        .to_vec(),
    )
}

pub(super) fn film(_: Seed) -> Item {
    let question = |film: UVec2| {
        let columns = (0..film.y).map(|y| Sample {
            pixel: uvec2(film.x / 2, y),
            offset: MIDDLE,
        });
        let samples = middle_row(film).into_iter().chain(columns).collect();
        let aspect = f64::from(film.x) / f64::from(film.y);
        direction_question(camera(90.0, aspect, film), samples)
    };
    item(
        "film",
        1,
        [
            "x is divided by the film's width, and y by its height",
            "The film need not be square, so do not mix up its two sizes or use one of them for \
             both axes.",
        ],
        [uvec2(17, 5), uvec2(5, 17)].map(question).to_vec(),
    )
}

pub(super) fn bottom_left(_: Seed) -> Item {
    let question = |n: u32| {
        let film = UVec2::splat(n);
        let samples = (0..n).map(|i| Sample {
            pixel: uvec2(i, i / 2),
            offset: MIDDLE,
        });
        direction_question(camera(90.0, 1.0, film), samples.collect())
    };
    item(
        "bottom_left",
        1,
        [
            "pixel (0, 0) is at the bottom left",
            "y points up on the film, as it does in space: a small y looks down, and a small x \
             looks left.",
        ],
        [8, 11].map(question).to_vec(),
    )
}
