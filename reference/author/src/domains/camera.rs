//! The domain of `Camera::sample_ray`.

use glam::{Vec2, uvec2};
use protocol::{PinholeCamera, Question, Sample};

use super::fields::class_up_to;
use super::{Aspect, FunctionDomain};
use crate::seed::Rng;

/// The domain of `Camera::sample_ray`.
pub static CAMERA: FunctionDomain<CameraCall> = FunctionDomain {
    function: "Camera::sample_ray",
    subject_aspects: &[],
    aspects: &[
        FIELD_OF_VIEW,
        ASPECT_RATIO,
        COLUMNS,
        ROWS,
        COLUMN,
        ROW,
        OFFSET_X,
        OFFSET_Y,
    ],
    pairs: &[],
    calls,
    not_asked: &[],
};

/// A call of `Camera::sample_ray`.
#[derive(Clone, Copy, Debug)]
pub struct CameraCall {
    camera: PinholeCamera,
    sample: Sample,
}

/// Parts of the vertical fields of view that the contract allows, in degrees.
pub const FIELDS_OF_VIEW: [(f64, f64); 8] = [
    (1.0, 1.0),
    (1.0, 10.0),
    (10.0, 30.0),
    (30.0, 60.0),
    (60.0, 120.0),
    (120.0, 150.0),
    (150.0, 175.0),
    (175.0, 175.0),
];

const FIELD_OF_VIEW: Aspect<CameraCall> = Aspect {
    name: "field of view",
    classes: &[
        "1°", "to 10°", "to 30°", "to 60°", "to 120°", "to 150°", "to 175°", "175°",
    ],
    class: |call| part(&FIELDS_OF_VIEW, call.camera.vertical_fov.into()),
};

/// Parts of the aspect ratios that the contract allows.
pub const ASPECT_RATIOS: [(f64, f64); 7] = [
    (0.1, 0.1),
    (0.1, 0.3),
    (0.3, 0.9),
    (0.9, 1.1),
    (1.1, 3.0),
    (3.0, 10.0),
    (10.0, 10.0),
];

const ASPECT_RATIO: Aspect<CameraCall> = Aspect {
    name: "aspect ratio",
    classes: &["0.1", "to 0.3", "to 0.9", "about 1", "to 3", "to 10", "10"],
    class: |call| part(&ASPECT_RATIOS, call.camera.aspect_ratio.into()),
};

/// The classes of the sides of a film.
const SIDES: &[&str] = &["1", "2 to 10", "11 to 255", "256 to 4095", "4096"];

const COLUMNS: Aspect<CameraCall> = Aspect {
    name: "columns of the film",
    classes: SIDES,
    class: |call| Some(side_class(call.camera.film.x)),
};

const ROWS: Aspect<CameraCall> = Aspect {
    name: "rows of the film",
    classes: SIDES,
    class: |call| Some(side_class(call.camera.film.y)),
};

/// The classes of positions on a film with more than two pixels along an axis.
const POSITIONS: &[&str] = &["first", "last", "between"];

const COLUMN: Aspect<CameraCall> = Aspect {
    name: "column",
    classes: POSITIONS,
    class: |call| position_class(call.sample.pixel.x, call.camera.film.x),
};

const ROW: Aspect<CameraCall> = Aspect {
    name: "row",
    classes: POSITIONS,
    class: |call| position_class(call.sample.pixel.y, call.camera.film.y),
};

/// The classes of offsets along an axis.
const OFFSETS: &[&str] = &[
    "0",
    "below 0.01",
    "below 0.5",
    "0.5",
    "above 0.5",
    "above 0.99",
];

const OFFSET_X: Aspect<CameraCall> = Aspect {
    name: "offset.x",
    classes: OFFSETS,
    class: |call| Some(offset_class(call.sample.offset.x)),
};

const OFFSET_Y: Aspect<CameraCall> = Aspect {
    name: "offset.y",
    classes: OFFSETS,
    class: |call| Some(offset_class(call.sample.offset.y)),
};

/// Returns the first part that contains a number, but for rounding.
fn part(parts: &[(f64, f64)], number: f64) -> Option<usize> {
    let fits = |(from, to): (f64, f64)| {
        let rounding = 1e-6 * number;
        from - rounding <= number && number <= to + rounding
    };
    let single = parts.iter().position(|&it| it.0 == it.1 && fits(it));
    single.or_else(|| parts.iter().position(|&it| fits(it)))
}

fn side_class(side: u32) -> usize {
    class_up_to(&[1, 10, 255, 4095], side as usize)
}

fn position_class(position: u32, count: u32) -> Option<usize> {
    (count > 2).then(|| match position {
        0 => 0,
        _ if position + 1 == count => 1,
        _ => 2,
    })
}

fn offset_class(offset: f32) -> usize {
    match offset {
        0.0 => 0,
        ..0.01 => 1,
        ..0.5 => 2,
        0.5 => 3,
        ..0.99 => 4,
        _ => 5,
    }
}

fn calls(question: &Question) -> Vec<CameraCall> {
    let Question::SampleRay(table) = question else {
        return Vec::new();
    };
    let camera = table.subject;
    let rows = table.rows.to_vec();
    let calls = rows.iter().map(|&sample| CameraCall { camera, sample });
    calls.collect()
}

/// Draws a number from a part of a domain.
pub fn drawn((from, to): (f64, f64), rng: &mut Rng) -> f64 {
    if from < to {
        rng.log_uniform(from, to)
    } else {
        from
    }
}

/// Draws an offset along one axis, often at an end.
pub fn offset(rng: &mut Rng) -> f32 {
    let offset = match rng.index(6) {
        0 => 0.0,
        1 => rng.log_uniform(1e-4, 0.01),
        2 => 1.0 - rng.log_uniform(1e-4, 0.01),
        _ => rng.uniform(0.02, 0.98),
    };
    offset as f32
}

/// Draws the side of a film from one of the classes.
pub fn side(rng: &mut Rng, class: usize) -> u32 {
    match class % SIDES.len() {
        0 => 1,
        1 => rng.integer(2, 10),
        2 => rng.integer(11, 255),
        3 => rng.integer(256, 4095),
        _ => 4096,
    }
}

/// Draws a pixel of a film, often one at an edge, and a position in it.
pub fn sample(rng: &mut Rng, camera: &PinholeCamera) -> Sample {
    let mut position = |count: u32| match rng.index(4) {
        0 => 0,
        1 => count - 1,
        _ => rng.index(count as usize) as u32,
    };
    Sample {
        pixel: uvec2(position(camera.film.x), position(camera.film.y)),
        offset: Vec2::new(offset(rng), offset(rng)),
    }
}
