//! Items of task 1: cameras.
//!
//! A mistake in one quantity should not make the items about other quantities fail. Most items
//! therefore use the middle row of the film, where only x matters, and the centres of pixels. The
//! film and the sensor have the same aspect ratio, except in the items about the aspect ratio.

mod ray;
mod sensor;

#[cfg(test)]
pub(super) use sensor::CORNERS;

use glam::{UVec2, Vec2, uvec2};
use judging::exam::{ExamQuestion, ExpectedRows, Key};
use protocol::{PinholeCamera, Question, Rows, Sample, SampleRay, Table};

use crate::domains::camera::CAMERA;
use crate::items::AuthoredTask;
use crate::oracle;
use crate::seed::Rng;

/// The task `camera`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        sensor::CORNERS,
        sensor::FIELD_OF_VIEW,
        sensor::ASPECT_RATIO,
        sensor::OTHER_ASPECT,
        sensor::FILM,
        sensor::BOTTOM_LEFT,
        ray::OFFSET,
        ray::OFFSET_AXES,
        ray::LARGE_FILM,
        ray::UNIT_LENGTH,
        ray::ORIGIN_AND_RANGE,
        ray::PICTURE,
    ],
    domains: &[&CAMERA],
    untested: &[
        (
            "[`Ray::new`] sets both.",
            "This is one way to do what the previous sentence asks.",
        ),
        (
            "Convert them with `as_vec2()` before you divide.",
            "This helps to do what the other sentences ask.",
        ),
    ],
    ..AuthoredTask::NEW
};

fn camera_question(judged: &[&str], camera: PinholeCamera, rows: Rows<Sample>) -> ExamQuestion {
    let direction = |sample: &Sample| oracle::camera::direction(&camera, *sample).as_vec3();
    let directions = rows.to_vec().iter().map(direction).collect();
    let directions = ExpectedRows::Rays(directions);
    let key = match rows {
        Rows::List(_) => Key::table(judged, directions),
        Rows::Picture(_) => Key::share_of_rows(judged, directions),
    };
    let table: Table<SampleRay> = Table {
        subject: camera,
        rows,
    };
    ExamQuestion::new(Question::SampleRay(table), key)
}

fn direction_question(
    camera: PinholeCamera,
    samples: impl IntoIterator<Item = Sample>,
) -> ExamQuestion {
    let samples = samples.into_iter().collect();
    camera_question(&["direction"], camera, Rows::List(samples))
}

fn camera(vertical_fov: f64, aspect_ratio: f64, film: UVec2) -> PinholeCamera {
    PinholeCamera {
        vertical_fov: vertical_fov as f32,
        aspect_ratio: aspect_ratio as f32,
        film,
    }
}

/// Returns a sample at the centre of each pixel in the middle row of a film with an odd number of
/// rows.
fn middle_row(film: UVec2) -> Vec<Sample> {
    (0..film.x).map(|x| middle_of(x, film.y / 2)).collect()
}

/// Returns the sample at the centre of a pixel.
fn middle_of(x: u32, y: u32) -> Sample {
    Sample {
        pixel: uvec2(x, y),
        offset: Vec2::splat(0.5),
    }
}

fn random_below(rng: &mut Rng, n: u32) -> u32 {
    rng.index(n as usize) as u32
}
