//! A ray of the camera: where it goes through the sensor; or from the side, where its start, its
//! length or its range is what is wrong.

mod front;
mod sensor;
mod side;

use glam::{DVec2, DVec3};
use protocol::{Answer, ElementOutcome, PinholeCamera, Ray, Sample};

use super::Drawing;

use sensor::Sensor;

/// One place on a camera's film.
#[derive(Clone, Copy, Debug)]
pub(super) struct CameraQuery {
    /// The camera.
    pub(super) camera: PinholeCamera,
    /// The place.
    pub(super) sample: Sample,
    /// Where its ray goes.
    pub(super) wanted: DVec3,
}

/// The drawing.
pub(super) fn draw(aim: &CameraQuery, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    let got = ray_answer(element, answer);
    let sensor = Sensor::new(&aim.camera)?;
    let wanted = sensor_crossing(aim.wanted)?;
    if let Some(ray) = got.filter(|ray| is_direction_right(ray, aim.wanted)) {
        return Some(side::draw(aim, &ray, &sensor));
    }
    Some(front::draw(aim, &sensor, wanted, got))
}

fn ray_answer(element: usize, answer: Option<&Answer>) -> Option<Ray> {
    let outcome = match answer {
        Some(Answer::Rays(rays)) => rays.get(element),
        Some(
            Answer::Hits(_)
            | Answer::Spans(_)
            | Answer::Tree(_)
            | Answer::Picture(_)
            | Answer::Done,
        )
        | None => None,
    };
    match outcome {
        Some(ElementOutcome::Value(ray)) => Some(*ray),
        Some(ElementOutcome::Panicked(_) | ElementOutcome::Skipped) | None => None,
    }
}

/// Where what goes this way crosses the plane z = -1; nowhere if it does not go forward.
fn sensor_crossing(dir: DVec3) -> Option<DVec2> {
    let place = dir.truncate() / -dir.z;
    (dir.z < 0.0 && place.is_finite()).then_some(place)
}

/// Only to choose what is drawn: the judge has finer measures.
fn is_direction_right(ray: &Ray, wanted: DVec3) -> bool {
    let dir = ray.dir.as_dvec3().normalize_or_zero();
    dir.distance(wanted) <= 1e-3
}
