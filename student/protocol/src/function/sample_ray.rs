//! `Camera::sample_ray`, which takes a position on the film and returns a ray.

use glam::UVec2;
use serde::{Deserialize, Serialize};

use super::{Function, Input, Output, Question, ResultText, Submission, Table, View};
use crate::answer::{Answer, ElementOutcome};
use crate::ray::Ray;
use crate::value::{Fields, fields};
use crate::view::{PinholeCamera, Sample};

/// Calls `Camera::sample_ray` for positions on the film.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SampleRay;

impl Function for SampleRay {
    type Subject = PinholeCamera;
    type Input = Sample;
    type Output = Ray;

    fn name(_: &PinholeCamera) -> &'static str {
        "Camera::sample_ray"
    }

    fn sentence(_: &PinholeCamera) -> &'static str {
        "camera ({vertical_fov}°, aspect ratio {aspect_ratio}), film {film}, pixel {pixel} + \
         {offset}"
    }

    fn question(table: Table<Self>) -> Question {
        Question::SampleRay(table)
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        camera: &'a PinholeCamera,
    ) -> impl Fn(&Sample) -> Ray + 'a {
        let camera = submission.camera(camera);
        move |sample| camera.ray(sample.pixel, sample.offset)
    }
}

fields! {
    PinholeCamera {
        "vertical_fov": Angle = vertical_fov,
        "aspect_ratio": Ratio = aspect_ratio,
        "film": Film = film,
    }
}

fields! {
    Sample {
        "pixel": Pixel = pixel,
        "offset": Offset = offset,
    }
}

fields! {
    Ray {
        "origin": Point = origin,
        "direction": Direction = dir,
        "range": Range = range,
    }
}

impl Input for Sample {
    type View = UVec2;
}

/// All positions on a film of this size.
impl View<Sample> for UVec2 {
    fn film(&self) -> UVec2 {
        *self
    }

    fn input(&self, sample: Sample) -> Sample {
        sample
    }
}

impl Output for Ray {
    type Record = Ray;

    const NAMES: &'static [&'static str] = <Ray as Fields>::NAMES;
    const RESULT_TEXT: ResultText = ResultText {
        record: "{ray}",
        present: "{ray}",
        absent: "no ray",
    };
    const MAX_BYTES: usize = 8 * size_of::<f32>();

    fn record(&self) -> Option<&Ray> {
        Some(self)
    }

    fn record_mut(&mut self) -> Option<&mut Ray> {
        Some(self)
    }

    fn answer(rows: Vec<ElementOutcome<Self>>) -> Answer {
        Answer::Rays(rows)
    }
}
