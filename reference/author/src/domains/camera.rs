//! The domain of `Camera::sample_ray`.

use glam::{UVec2, Vec2, uvec2};
use protocol::{PinholeCamera, Question, Sample};

use super::fields::class_up_to;
use super::{Aspect, FunctionDomain, not_asked};
use crate::oracle::camera;
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
        LARGE_PIXEL_X,
        LARGE_PIXEL_Y,
        ANGLE,
        SENSOR,
        ROUND_ANGLE,
        USUAL_RATIO,
        PIXELS,
        VIEW,
    ],
    pairs: &[
        ["angle", "sensor"],
        ["angle", "rows of the film"],
        ["sensor", "columns of the film"],
        ["sensor", "rows of the film"],
    ],
    calls,
    not_asked: &[
        not_asked(
            "",
            &["of a large film"],
            OTHER_QUANTITIES,
            "The place in a pixel changes the direction only.",
        ),
        not_asked(
            "round field of view",
            &[],
            OTHER_QUANTITIES,
            "The field of view changes the direction only.",
        ),
        not_asked(
            "usual aspect ratio",
            &[],
            OTHER_QUANTITIES,
            "The aspect ratio changes the direction only.",
        ),
        not_asked(
            "pixels",
            &[],
            OTHER_QUANTITIES,
            "The form of the pixels changes the direction only.",
        ),
        not_asked(
            "view",
            &[],
            OTHER_QUANTITIES,
            "The form of the view changes the direction only.",
        ),
    ],
};

/// The quantities of a ray other than its direction.
const OTHER_QUANTITIES: &[&str] = &["origin", "range", "unit_direction"];

/// A call of `Camera::sample_ray`.
#[derive(Clone, Copy, Debug)]
pub struct CameraCall {
    camera: PinholeCamera,
    sample: Sample,
}

/// Intervals of the vertical fields of view that the contract allows, in degrees.
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

/// Intervals of the aspect ratios that the contract allows.
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

/// Pixels of a large film that are so wide that the offset matters.
const LARGE_PIXEL_X: Aspect<CameraCall> = Aspect {
    name: "wide pixel",
    classes: &["of a large film"],
    class: |call| call.has_large_pixel(0).then_some(0),
};

/// Pixels of a large film that are so high that the offset matters.
const LARGE_PIXEL_Y: Aspect<CameraCall> = Aspect {
    name: "high pixel",
    classes: &["of a large film"],
    class: |call| call.has_large_pixel(1).then_some(0),
};

impl CameraCall {
    /// Returns whether the film has many pixels along an axis but the offset in this one still
    /// matters.
    fn has_large_pixel(&self, axis: usize) -> bool {
        /// The minimum number of pixels.
        const MANY: u32 = 2048;
        /// The minimum angle that matters, in radians.
        const LEAST: f64 = 2e-3;
        let mut in_the_middle = self.sample;
        in_the_middle.offset[axis] = 0.5;
        let [one, other] =
            [self.sample, in_the_middle].map(|sample| camera::direction(&self.camera, sample));
        self.camera.film[axis] >= MANY && one.angle_between(other) > LEAST
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

/// Intervals of the vertical fields of view for each class of [`ANGLE`].
const ANGLES: [[(f64, f64); 3]; 3] = [
    [(1.0, 1.0), (1.0, 5.0), (5.0, 15.0)],
    [(16.0, 30.0), (30.0, 60.0), (60.0, 120.0)],
    [(175.0, 175.0), (165.0, 175.0), (121.0, 150.0)],
];

/// Intervals of the aspect ratios for each class of [`SENSOR`].
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

/// Fields of view with a known tangent, in degrees.
pub const ROUND_ANGLES: [f64; 5] = [30.0, 45.0, 60.0, 90.0, 120.0];

const ROUND_ANGLE: Aspect<CameraCall> = Aspect {
    name: "round field of view",
    classes: &["30°", "45°", "60°", "90°", "120°"],
    class: |call| {
        let angle = f64::from(call.camera.vertical_fov);
        ROUND_ANGLES.iter().position(|it| *it == angle)
    },
};

/// The largest relative difference between ratios that are almost the same.
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
    classes: &["16/9", "almost 16/9", "4/3", "almost 4/3"],
    class: |call| {
        let ratio = f64::from(call.camera.aspect_ratio);
        let of_wide = almost_one(ratio / WIDE);
        of_wide.or_else(|| Some(2 + almost_one(ratio / OLD)?))
    },
};

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

/// Views that are extreme in two ways.
const VIEW: Aspect<CameraCall> = Aspect {
    name: "view",
    classes: &[
        "a single wide pixel",
        "a square film at 90° with another sensor",
        "an end of a view of 1° to 5° on a wide sensor",
        "an end of a view of 10° to 15° on a wide sensor",
        "the middle of the widest view",
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
            10.0..15.0 if dir.x.abs() > 0.4 => Some(3),
            173.0.. if aspect_ratio > 7.0 && dir.z < -0.99 => Some(4),
            _ => None,
        }
    },
};

/// Returns the index of the first interval that contains a number, up to rounding.
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
    let calls = rows.iter().map(|&sample| CameraCall { camera, sample });
    calls.collect()
}

/// Draws a number from an interval of a domain.
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

/// Draws the width or height of a film from one of the classes.
pub fn side(rng: &mut Rng, class: usize) -> u32 {
    match class % SIDES.len() {
        0 => 1,
        1 => rng.integer(2, 10),
        2 => rng.integer(11, 255),
        3 => rng.integer(256, 4095),
        _ => 4096,
    }
}

/// Draws cameras with all angles of view, sensors and films. Most differ from the previous one in a
/// single field and are asked for the same samples, so that a method that keeps state between calls
/// fails.
pub fn cameras(rng: &mut Rng) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let (classes, forms) = (
        rng.shuffled((0..SIDES.len()).collect()),
        rng.shuffled((0..SENSORS.len()).collect()),
    );
    let mut asked = [[0; SENSORS.len()]; ANGLES.len()];
    let mut cameras = Vec::new();
    for (pair, classes) in classes.chunks(2).enumerate() {
        let [first, second, third] = [0, 1, 2].map(|it| forms[(pair + it) % forms.len()]);
        // The first sensor is at both ends, so that only the film changes when it is rotated.
        let ends = [first, second, second, third, third, first];
        let film = uvec2(side(rng, classes[0]), side(rng, classes[classes.len() - 1]));
        let mut camera = PinholeCamera {
            vertical_fov: 0.0,
            aspect_ratio: 0.0,
            film,
        };
        let mut samples = samples_of_both(rng, film);
        let (mut last_angle, mut last_form) = (None, None);
        for turn in 0..classes.len() {
            for (step, &form) in ends.iter().enumerate() {
                let angle = if turn == 0 { step / 2 } else { 2 - step / 2 };
                let times = &mut asked[angle][form];
                if last_angle.replace(angle) != Some(angle) {
                    camera.vertical_fov = drawn(ANGLES[angle][*times % 3], rng) as f32;
                }
                if last_form.replace(form) != Some(form) {
                    let ratios = SENSORS[form];
                    camera.aspect_ratio = drawn(ratios[*times % ratios.len()], rng) as f32;
                }
                *times += 1;
                cameras.push((camera, samples.clone()));
                // The last sample of a camera is the first of the next one.
                samples.reverse();
            }
            camera.film = uvec2(film.y, film.x);
            samples.retain(|sample| sample.pixel.cmplt(camera.film).all());
        }
    }
    cameras
}

/// Draws cameras that each differ from the previous one in a single field, most by less than 1%. They
/// are asked for the same samples.
pub fn almost_equal_cameras(
    rng: &mut Rng,
    first: PinholeCamera,
) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let almost = |rng: &mut Rng, ratio: f64| {
        let difference = rng.sign() * rng.uniform(0.4, 0.9) * ALMOST;
        (ratio * (1.0 + difference)) as f32
    };
    let mut cameras = vec![first];
    let mut add = |change: &dyn Fn(&mut PinholeCamera)| {
        let mut camera = cameras[cameras.len() - 1];
        change(&mut camera);
        cameras.push(camera);
    };
    let ratio = almost(rng, first.aspect_ratio.into());
    add(&|camera| camera.aspect_ratio = ratio);
    let angle = (rng.sign() * rng.uniform(0.2, 0.45)) as f32;
    add(&|camera| camera.vertical_fov += angle);
    let rows = (f64::from(first.film.y) * rng.uniform(0.5, 0.8)).round() as u32;
    add(&|camera| camera.film.y = rows);
    let ratio = almost(rng, OLD);
    add(&|camera| camera.aspect_ratio = ratio);
    let columns = (f64::from(rows) * OLD).round() as u32;
    add(&|camera| camera.film.x = columns);
    add(&|camera| camera.aspect_ratio = OLD as f32);
    // All films contain the same pixels.
    let film = cameras.iter().map(|camera| camera.film);
    let film = film.reduce(UVec2::min).unwrap_or(first.film);
    let mut samples: Vec<Sample> = (0..8).map(|_| sample(rng, film)).collect();
    let ends = [UVec2::ZERO, film - 1];
    for (row, pixel) in [(0, ends[0]), (1, ends[1]), (6, ends[1]), (7, ends[0])] {
        samples[row].pixel = pixel;
    }
    let mut all = Vec::new();
    for camera in cameras {
        all.push((camera, samples.clone()));
        // The last sample of a camera is the first of the next one.
        samples.reverse();
    }
    all
}

/// Draws samples at the ends of narrow views on wide sensors, and in a single pixel with a wide view.
pub fn extreme_views(rng: &mut Rng) -> Vec<(PinholeCamera, Vec<Sample>)> {
    let mut all = Vec::new();
    for (from, to) in [(3.5, 4.95), (10.0, 15.0)] {
        let film = uvec2(rng.integer(11, 255), rng.integer(2, 255));
        let narrow = PinholeCamera {
            vertical_fov: rng.uniform(from, to) as f32,
            aspect_ratio: rng.uniform(7.0, 10.0) as f32,
            film,
        };
        let ends = (0..8).map(|index| Sample {
            pixel: uvec2([0, film.x - 1][index % 2], rng.integer(0, film.y - 1)),
            offset: Vec2::new(offset(rng), offset(rng)),
        });
        all.push((narrow, ends.collect()));
    }
    let single = PinholeCamera {
        vertical_fov: rng.uniform(121.0, 175.0) as f32,
        aspect_ratio: rng.log_uniform(0.3, 3.0) as f32,
        film: UVec2::ONE,
    };
    let of_single = (0..8).map(|_| sample(rng, single.film)).collect();
    all.push((single, of_single));
    all
}

/// Draws samples of a film. The first and the last also exist in the rotated film. Some follow a
/// sample with x and y swapped.
fn samples_of_both(rng: &mut Rng, film: UVec2) -> Vec<Sample> {
    let square = UVec2::splat(film.min_element());
    let films = [square, square, film, film, film, film, square, square];
    let mut samples = films.map(|film| sample(rng, film)).to_vec();
    let Sample { pixel, offset } = samples[1];
    let exchanged = Sample {
        pixel: uvec2(pixel.y, pixel.x),
        offset: Vec2::new(offset.y, offset.x),
    };
    samples.insert(2, exchanged);
    samples
}

/// Draws a pixel of a film, often at an edge, and a position in it.
pub fn sample(rng: &mut Rng, film: UVec2) -> Sample {
    let mut position = |count: u32| match rng.index(5) {
        0 => 0,
        1 => count - 1,
        2 => count / 2,
        _ => rng.index(count as usize) as u32,
    };
    Sample {
        pixel: uvec2(position(film.x), position(film.y)),
        offset: Vec2::new(offset(rng), offset(rng)),
    }
}
