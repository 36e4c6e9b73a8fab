//! The domain of `Camera::sample_ray`.

mod draw;

use glam::UVec2;
use protocol::{PinholeCamera, Question, Sample};

use super::fields::class_up_to;
use super::{Aspect, FunctionDomain, not_asked};
use crate::oracle::camera;

pub use draw::{
    almost_equal_cameras, almost_usual_cameras, cameras, common_films, drawn, extreme_views,
    films_of_few_pixels, offset, sample, side,
};

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
        LARGE_PIXEL_X,
        LARGE_PIXEL_Y,
        ANGLE,
        SENSOR,
        ROUND_ANGLE,
        USUAL_RATIO,
        PIXELS,
        FILM,
        FEW_PIXELS,
        COMMON_FILM,
        VIEW,
        HISTORY,
    ],
    pairs: &[
        ["angle", "sensor"],
        ["angle", "rows of the film"],
        ["sensor", "columns of the film"],
        ["sensor", "rows of the film"],
    ],
    fields: &[],
    calls,
    not_asked: &[not_asked(
        &[
            "wide pixel",
            "high pixel",
            "round field of view",
            "usual aspect ratio",
            "pixels",
            "film",
            "film of few pixels",
            "film of a common size",
            "view",
            "sample before",
        ],
        &[],
        OTHER_QUANTITIES,
        "These aspects affect only the ray's direction.",
    )],
};

/// The quantities of a ray other than its direction.
const OTHER_QUANTITIES: &[&str] = &["origin", "range", "unit_direction"];

/// A call to `Camera::sample_ray`.
#[derive(Clone, Copy, Debug)]
pub struct CameraCall {
    camera: PinholeCamera,
    sample: Sample,
    /// The sample of the previous call, if that call was on the same camera.
    before: Option<Sample>,
}

/// The vertical fields of view that the contract allows, as ranges in degrees.
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

/// The aspect ratios that the contract allows, as ranges.
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

/// The classes of the film's width and height.
const SIDES: &[&str] = &["1", "2", "3", "4 to 10", "11 to 255", "256 to 4095", "4096"];

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
const POSITIONS: &[&str] = &["first", "last", "in the middle", "elsewhere"];

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

/// The pixels per axis of large films.
const LARGE_FILMS: &[&str] = &["2,048 to 3,499 pixels", "3,500 to 4,096 pixels"];

/// Pixels of a large film that are so wide that the offset matters.
const LARGE_PIXEL_X: Aspect<CameraCall> = Aspect {
    name: "wide pixel",
    classes: LARGE_FILMS,
    class: |call| call.large_pixel_class(0),
};

/// Pixels of a large film that are so high that the offset matters.
const LARGE_PIXEL_Y: Aspect<CameraCall> = Aspect {
    name: "high pixel",
    classes: LARGE_FILMS,
    class: |call| call.large_pixel_class(1),
};

impl CameraCall {
    /// Returns the class of a film that has many pixels along an axis, if the offset in this pixel
    /// still matters.
    fn large_pixel_class(&self, axis: usize) -> Option<usize> {
        /// The minimum angle that matters, in radians.
        const LEAST: f64 = 2e-3;
        let mut in_the_middle = self.sample;
        in_the_middle.offset[axis] = 0.5;
        let [one, other] =
            [self.sample, in_the_middle].map(|sample| camera::direction(&self.camera, sample));
        let is_large = one.angle_between(other) > LEAST;
        match self.camera.film[axis] {
            2048..3500 if is_large => Some(0),
            3500.. if is_large => Some(1),
            _ => None,
        }
    }
}

/// The angles of view.
const ANGLE: Aspect<CameraCall> = Aspect {
    name: "angle",
    classes: &["narrow", "usual", "wide"],
    class: |call| {
        Some(class_up_to(
            &[15, 120],
            call.camera.vertical_fov.round() as usize,
        ))
    },
};

/// The ranges of vertical fields of view for each class of [`ANGLE`], in degrees.
const ANGLES: [[(f64, f64); 3]; 3] = [
    [(1.0, 1.0), (1.0, 5.0), (5.0, 15.0)],
    [(16.0, 30.0), (30.0, 60.0), (60.0, 120.0)],
    [(175.0, 175.0), (165.0, 175.0), (121.0, 150.0)],
];

/// The ranges of aspect ratios for each class of [`SENSOR`].
const SENSORS: [&[(f64, f64)]; 3] = [
    &[(0.1, 0.1), (0.1, 0.3), (0.3, 0.89)],
    &[(0.9, 1.1)],
    &[(1.11, 3.0), (3.0, 10.0), (10.0, 10.0)],
];

/// The aspect ratio of the sensor.
const SENSOR: Aspect<CameraCall> = Aspect {
    name: "sensor",
    classes: &["upright", "about square", "wide"],
    class: |call| {
        Some(match call.camera.aspect_ratio {
            ..0.9 => 0,
            ..1.1 => 1,
            _ => 2,
        })
    },
};

/// Fields of view whose tangents are well known, in degrees.
pub const ROUND_ANGLES: [f64; 5] = [30.0, 45.0, 60.0, 90.0, 120.0];

const ROUND_ANGLE: Aspect<CameraCall> = Aspect {
    name: "round field of view",
    classes: &[
        "30°",
        "45°",
        "60°",
        "90°",
        "120°",
        "almost 30°",
        "almost 45°",
        "almost 60°",
        "almost 90°",
        "almost 120°",
    ],
    class: |call| {
        let angle = f64::from(call.camera.vertical_fov);
        let within = |most: f64| {
            ROUND_ANGLES
                .iter()
                .position(|it| (it - angle).abs() <= most)
        };
        within(0.0).or_else(|| Some(ROUND_ANGLES.len() + within(1.0)?))
    },
};

/// The relative difference below which two ratios count as almost the same.
const ALMOST: f64 = 0.01;

/// Returns 0 if a ratio is 1 up to rounding, and 1 if it is almost 1.
fn almost_one(ratio: f64) -> Option<usize> {
    match (ratio - 1.0).abs() {
        ..1e-6 => Some(0),
        ..ALMOST => Some(1),
        _ => None,
    }
}

const USUAL_RATIO: Aspect<CameraCall> = Aspect {
    name: "usual aspect ratio",
    classes: &[
        "16/9",
        "almost 16/9",
        "4/3",
        "almost 4/3",
        "almost 1",
        "almost 5/4",
        "almost 3/2",
        "almost 16/10",
        "almost 1.85",
        "almost 2",
        "almost 21/9",
        "almost 2.39",
    ],
    class: |call| {
        let ratio = f64::from(call.camera.aspect_ratio);
        let of_wide = almost_one(ratio / WIDE);
        let of_old = || Some(2 + almost_one(ratio / OLD)?);
        let mut others = USUAL_RATIOS.iter();
        let of_others = || Some(4 + others.position(|it| almost_one(ratio / it) == Some(1))?);
        of_wide.or_else(of_old).or_else(of_others)
    },
};

/// Other common aspect ratios of sensors.
const USUAL_RATIOS: [f64; 8] = [1.0, 1.25, 1.5, 1.6, 1.85, 2.0, 7.0 / 3.0, 2.39];

/// The aspect ratio of most films.
const WIDE: f64 = 16.0 / 9.0;
/// The aspect ratio of old films.
const OLD: f64 = 4.0 / 3.0;

/// The aspect ratio of the pixels on the sensor.
const PIXELS: Aspect<CameraCall> = Aspect {
    name: "pixels",
    classes: &["square", "almost square", "not square"],
    class: |call| {
        let film = call.camera.film.as_dvec2();
        let ratio = f64::from(call.camera.aspect_ratio) * film.y / film.x;
        Some(almost_one(ratio).unwrap_or(2))
    },
};

/// Films that are strips two or more pixels wide.
const FILM: Aspect<CameraCall> = Aspect {
    name: "film",
    classes: &["a horizontal strip", "an upright strip"],
    class: |call| {
        let film = call.camera.film;
        let (least, most) = (film.min_element(), film.max_element());
        (least > 1 && most > 50 * least).then_some(usize::from(film.y == most))
    },
};

/// Films that have more than one pixel, but only a few.
const FEW_PIXELS: Aspect<CameraCall> = Aspect {
    name: "film of few pixels",
    classes: &["2 × 1", "1 × 2", "2 × 2", "3 × 1", "1 × 3", "up to 3 × 3"],
    class: |call| match call.camera.film.to_array() {
        [2, 1] => Some(0),
        [1, 2] => Some(1),
        [2, 2] => Some(2),
        [3, 1] => Some(3),
        [1, 3] => Some(4),
        [2..=3, 2..=3] => Some(5),
        _ => None,
    },
};

/// Common film sizes, in pixels.
const COMMON_FILMS: [(u32, u32); 8] = [
    (1280, 720),
    (1920, 1080),
    (640, 480),
    (1024, 1024),
    (512, 512),
    (256, 256),
    (128, 128),
    (64, 64),
];

/// Films of a common size, if the sensor's aspect ratio differs from the film's.
const COMMON_FILM: Aspect<CameraCall> = Aspect {
    name: "film of a common size",
    classes: &[
        "1280 × 720",
        "1920 × 1080",
        "640 × 480",
        "1024 × 1024",
        "512 × 512",
        "256 × 256",
        "128 × 128",
        "64 × 64",
    ],
    class: |call| {
        let film = call.camera.film;
        let is_square = (PIXELS.class)(call) == Some(0);
        let mut films = COMMON_FILMS.into_iter();
        films.position(|it| UVec2::from(it) == film && !is_square)
    },
};

/// The previous sample on the same camera. A sample "in the same column" also shares its offset in
/// x, and one "in the same row" shares its offset in y. All classes but the first two contain only
/// calls with clearly different answers.
const HISTORY: Aspect<CameraCall> = Aspect {
    name: "sample before",
    classes: &[
        "none",
        "any",
        "in the same column",
        "in the same row",
        "in the same pixel",
        "with the same offset in another pixel",
        "less than 4e-4 pixels away",
    ],
    class: |call| {
        /// The distance between two samples that hardly differ, in pixels.
        const HARDLY: f32 = 4e-4;
        /// The smallest angle between their directions, in radians.
        const LEAST: f64 = 2e-3;
        let Some(before) = call.before else {
            return Some(0);
        };
        let [dir, dir_before] =
            [call.sample, before].map(|sample| camera::direction(&call.camera, sample));
        let is_other_direction = dir.angle_between(dir_before) > LEAST;
        let Sample { pixel, offset } = call.sample;
        let same_pixel = before.pixel.cmpeq(pixel);
        let same_offset = before.offset.cmpeq(offset);
        Some(match <[bool; 2]>::from(same_pixel & same_offset) {
            _ if !is_other_direction => 1,
            _ if same_pixel.all() && before.offset.distance(offset) < HARDLY => 6,
            [true, _] => 2,
            [_, true] => 3,
            _ if same_pixel.all() => 4,
            _ if same_offset.all() => 5,
            _ => 1,
        })
    },
};

/// Views that are extreme in two ways.
const VIEW: Aspect<CameraCall> = Aspect {
    name: "view",
    classes: &[
        "a single wide pixel",
        "a field of view of 90° with a square film, but a sensor that is not square",
        "an edge of the image, for a 1° to 5° field of view and a wide sensor",
        "an edge of the image, for a 10° to 15° field of view and a wide sensor",
        "the centre of the image, for the widest field of view",
        "an edge of the image, for a 5° to 10° field of view and a wide sensor",
        "the centre of the image, for a 60° to 100° field of view, a wide sensor and a large film",
    ],
    class: |call| {
        let PinholeCamera {
            vertical_fov,
            aspect_ratio,
            film,
        } = call.camera;
        let dir = camera::direction(&call.camera, call.sample);
        let is_square = film.x == film.y;
        match vertical_fov {
            120.0.. if film == UVec2::ONE => Some(0),
            90.0 if is_square && film.x > 1 && aspect_ratio != 1.0 => Some(1),
            1.0..5.0 if dir.x.abs() > 0.2 => Some(2),
            5.0..10.0 if dir.x.abs() > 0.4 => Some(5),
            60.0..=100.0 if aspect_ratio > 7.0 && dir.z < -0.99 && film.min_element() >= 1024 => {
                Some(6)
            }
            10.0..15.0 if dir.x.abs() > 0.4 => Some(3),
            173.0.. if aspect_ratio > 7.0 && dir.z < -0.99 => Some(4),
            _ => None,
        }
    },
};

/// Returns the index of the first range that contains a number, up to rounding.
fn part(parts: &[(f64, f64)], number: f64) -> Option<usize> {
    let fits = |(from, to): (f64, f64)| {
        let rounding = 1e-6 * number;
        from - rounding <= number && number <= to + rounding
    };
    let single = parts.iter().position(|&it| it.0 == it.1 && fits(it));
    single.or_else(|| parts.iter().position(|&it| fits(it)))
}

fn side_class(side: u32) -> usize {
    class_up_to(&[1, 2, 3, 10, 255, 4095], side as usize)
}

fn position_class(position: u32, count: u32) -> Option<usize> {
    (count > 2).then(|| match position {
        0 => 0,
        _ if position + 1 == count => 1,
        _ if (2 * position + 1).abs_diff(count) <= 1 => 2,
        _ => 3,
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
    let before = std::iter::once(None).chain(rows.iter().copied().map(Some));
    let calls = rows.iter().zip(before).map(|(&sample, before)| CameraCall {
        camera,
        sample,
        before,
    });
    calls.collect()
}
