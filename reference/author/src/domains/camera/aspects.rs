//! The aspects of calls to `Camera::sample_ray`.

use glam::UVec2;
use protocol::{PinholeCamera, Sample};

use super::CameraCall;
use crate::domains::Aspect;
use crate::domains::fields::{class_below, class_up_to};
use crate::oracle::camera;

/// The aspects of cameras and samples.
pub(super) const ASPECTS: &[Aspect<CameraCall>] = &[
    Aspect::new(
        "field of view",
        &[
            "1°", "to 10°", "to 30°", "to 60°", "to 120°", "to 150°", "to 175°", "175°",
        ],
        |call| part(&FIELDS_OF_VIEW, call.camera.vertical_fov.into()),
    ),
    Aspect::new(
        "aspect ratio",
        &["0.1", "to 0.3", "to 0.9", "about 1", "to 3", "to 10", "10"],
        |call| part(&ASPECT_RATIOS, call.camera.aspect_ratio.into()),
    ),
    Aspect::new("columns of the film", SIDES, |call| {
        Some(side_class(call.camera.film.x))
    }),
    Aspect::new("rows of the film", SIDES, |call| {
        Some(side_class(call.camera.film.y))
    }),
    Aspect::new("column", POSITIONS, |call| {
        position_class(call.sample.pixel.x, call.camera.film.x)
    }),
    Aspect::new("row", POSITIONS, |call| {
        position_class(call.sample.pixel.y, call.camera.film.y)
    }),
    Aspect::new("offset.x", OFFSETS, |call| {
        Some(offset_class(call.sample.offset.x))
    }),
    Aspect::new("offset.y", OFFSETS, |call| {
        Some(offset_class(call.sample.offset.y))
    }),
    // Pixels of a large film that are so wide that the offset matters.
    Aspect::new("wide pixel", LARGE_FILMS, |call| call.large_pixel_class(0)),
    // Pixels of a large film that are so high that the offset matters.
    Aspect::new("high pixel", LARGE_FILMS, |call| call.large_pixel_class(1)),
    // The angles of view.
    Aspect::new("angle", &["narrow", "usual", "wide"], |call| {
        Some(class_up_to(
            &[15, 120],
            call.camera.vertical_fov.round() as usize,
        ))
    }),
    // The aspect ratio of the sensor.
    Aspect::new("sensor", &["upright", "about square", "wide"], |call| {
        Some(class_below(&[0.9, 1.1], call.camera.aspect_ratio))
    }),
    Aspect::new(
        "round field of view",
        &[
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
        |call| {
            let angle = f64::from(call.camera.vertical_fov);
            let within = |most: f64| {
                ROUND_ANGLES
                    .iter()
                    .position(|it| (it - angle).abs() <= most)
            };
            within(0.0).or_else(|| Some(ROUND_ANGLES.len() + within(1.0)?))
        },
    ),
    Aspect::new(
        "usual aspect ratio",
        &[
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
        |call| {
            let ratio = f64::from(call.camera.aspect_ratio);
            let of_wide = almost_one(ratio / WIDE);
            let of_old = || Some(2 + almost_one(ratio / OLD)?);
            let mut others = USUAL_RATIOS.iter();
            let of_others = || Some(4 + others.position(|it| almost_one(ratio / it) == Some(1))?);
            of_wide.or_else(of_old).or_else(of_others)
        },
    ),
    // The aspect ratio of the pixels on the sensor.
    Aspect::new(
        "pixels",
        &["square", "almost square", "not square"],
        |call| Some(pixels_class(&call.camera)),
    ),
    // Films that are strips two or more pixels wide.
    Aspect::new(
        "film",
        &["a horizontal strip", "an upright strip"],
        |call| {
            let film = call.camera.film;
            let (least, most) = (film.min_element(), film.max_element());
            (least > 1 && most > 50 * least).then_some(usize::from(film.y == most))
        },
    ),
    // Films that have more than one pixel, but only a few.
    Aspect::new(
        "film of few pixels",
        &["2 × 1", "1 × 2", "2 × 2", "3 × 1", "1 × 3", "up to 3 × 3"],
        |call| match call.camera.film.to_array() {
            [2, 1] => Some(0),
            [1, 2] => Some(1),
            [2, 2] => Some(2),
            [3, 1] => Some(3),
            [1, 3] => Some(4),
            [2..=3, 2..=3] => Some(5),
            _ => None,
        },
    ),
    // Films of a common size, if the sensor's aspect ratio differs from the film's.
    Aspect::new(
        "film of a common size",
        &[
            "1280 × 720",
            "1920 × 1080",
            "640 × 480",
            "1024 × 1024",
            "512 × 512",
            "256 × 256",
            "128 × 128",
            "64 × 64",
        ],
        |call| {
            let film = call.camera.film;
            let is_square = pixels_class(&call.camera) == 0;
            let mut films = COMMON_FILMS.into_iter();
            films.position(|it| UVec2::from(it) == film && !is_square)
        },
    ),
    // Views that are extreme in two ways.
    Aspect::new(
        "view",
        &[
            "a single wide pixel",
            "a field of view of 90° with a square film, but a sensor that is not square",
            "an edge of the image, for a 1° to 5° field of view and a wide sensor",
            "an edge of the image, for a 10° to 15° field of view and a wide sensor",
            "the centre of the image, for the widest field of view",
            "an edge of the image, for a 5° to 10° field of view and a wide sensor",
            "the centre of the image, for a 60° to 100° field of view, a wide sensor and a large \
             film",
        ],
        |call| {
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
                60.0..=100.0
                    if aspect_ratio > 7.0 && dir.z < -0.99 && film.min_element() >= 1024 =>
                {
                    Some(6)
                }
                10.0..15.0 if dir.x.abs() > 0.4 => Some(3),
                173.0.. if aspect_ratio > 7.0 && dir.z < -0.99 => Some(4),
                _ => None,
            }
        },
    ),
    // The previous sample on the same camera. A sample "in the same column" also shares its offset
    // in x, and one "in the same row" shares its offset in y. All classes but the first two contain
    // only calls with clearly different answers.
    Aspect::new(
        "sample before",
        &[
            "none",
            "any",
            "in the same column",
            "in the same row",
            "in the same pixel",
            "with the same offset in another pixel",
            "less than 4e-4 pixels away",
        ],
        |call| {
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
    ),
];

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

/// The classes of the film's width and height.
pub(super) const SIDES: &[&str] = &["1", "2", "3", "4 to 10", "11 to 255", "256 to 4095", "4096"];

/// The classes of positions on a film with more than two pixels along an axis.
const POSITIONS: &[&str] = &["first", "last", "in the middle", "elsewhere"];

/// The classes of offsets along an axis.
const OFFSETS: &[&str] = &[
    "0",
    "below 0.01",
    "below 0.5",
    "0.5",
    "above 0.5",
    "above 0.99",
];

/// The pixels per axis of large films.
const LARGE_FILMS: &[&str] = &["2,048 to 3,499 pixels", "3,500 to 4,096 pixels"];

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

/// The ranges of vertical fields of view for each class of angles, in degrees.
pub(super) const ANGLES: [[(f64, f64); 3]; 3] = [
    [(1.0, 1.0), (1.0, 5.0), (5.0, 15.0)],
    [(16.0, 30.0), (30.0, 60.0), (60.0, 120.0)],
    [(175.0, 175.0), (165.0, 175.0), (121.0, 150.0)],
];

/// The ranges of aspect ratios for each class of sensors.
pub(super) const SENSORS: [&[(f64, f64)]; 3] = [
    &[(0.1, 0.1), (0.1, 0.3), (0.3, 0.89)],
    &[(0.9, 1.1)],
    &[(1.11, 3.0), (3.0, 10.0), (10.0, 10.0)],
];

/// Fields of view whose tangents are well known, in degrees.
pub const ROUND_ANGLES: [f64; 5] = [30.0, 45.0, 60.0, 90.0, 120.0];

/// The relative difference below which two ratios count as almost the same.
pub(super) const ALMOST: f64 = 0.01;

/// Returns 0 if a ratio is 1 up to rounding, and 1 if it is almost 1.
fn almost_one(ratio: f64) -> Option<usize> {
    match (ratio - 1.0).abs() {
        ..1e-6 => Some(0),
        ..ALMOST => Some(1),
        _ => None,
    }
}

/// Other common aspect ratios of sensors.
pub(super) const USUAL_RATIOS: [f64; 8] = [1.0, 1.25, 1.5, 1.6, 1.85, 2.0, 7.0 / 3.0, 2.39];

/// The aspect ratio of most films.
const WIDE: f64 = 16.0 / 9.0;
/// The aspect ratio of old films.
pub(super) const OLD: f64 = 4.0 / 3.0;

/// Returns the class of the pixels' aspect ratio on the sensor.
fn pixels_class(camera: &PinholeCamera) -> usize {
    let film = camera.film.as_dvec2();
    let ratio = f64::from(camera.aspect_ratio) * film.y / film.x;
    almost_one(ratio).unwrap_or(2)
}

/// Common film sizes, in pixels.
pub(super) const COMMON_FILMS: [(u32, u32); 8] = [
    (1280, 720),
    (1920, 1080),
    (640, 480),
    (1024, 1024),
    (512, 512),
    (256, 256),
    (128, 128),
    (64, 64),
];

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
