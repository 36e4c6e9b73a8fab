//! A camera ray. The drawing shows where the ray goes through the sensor. If its direction is
//! right, the drawing shows its origin, length and range from the side instead.

mod front;
mod sensor;
mod side;

use glam::{DVec2, DVec3};
use protocol::{Answer, PinholeCamera, Ray, Sample};

use super::{Drawing, value};

use sensor::Sensor;

/// A question about one sample of a camera, with the expected direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct CameraQuery {
    /// The camera that generates the ray.
    pub(super) camera: PinholeCamera,
    /// The sampled pixel, and the offset within it.
    pub(super) sample: Sample,
    /// The expected direction of the ray.
    pub(super) wanted: DVec3,
}

/// Draws one camera ray.
pub(super) fn draw(
    query: &CameraQuery,
    element: usize,
    answer: Option<&Answer>,
) -> Option<Drawing> {
    let got = ray_answer(element, answer);
    let sensor = Sensor::new(&query.camera)?;
    let wanted = sensor_crossing(query.wanted)?;
    if let Some(ray) = got.filter(|ray| is_direction_right(ray, query.wanted)) {
        return Some(side::draw(query, &ray, &sensor));
    }
    Some(front::draw(query, &sensor, wanted, got))
}

fn ray_answer(element: usize, answer: Option<&Answer>) -> Option<Ray> {
    let Some(Answer::Rays(rays)) = answer else {
        return None;
    };
    value(rays, element).copied()
}

/// Returns the point where a direction crosses the plane z = -1, or `None` if it does not point
/// forward.
fn sensor_crossing(dir: DVec3) -> Option<DVec2> {
    let point = dir.truncate() / -dir.z;
    (dir.z < 0.0 && point.is_finite()).then_some(point)
}

/// Returns whether a ray's direction is about right. This only decides which view is drawn; the
/// judge has finer tolerances.
fn is_direction_right(ray: &Ray, wanted: DVec3) -> bool {
    let dir = ray.dir.as_dvec3().normalize_or_zero();
    dir.distance(wanted) <= 1e-3
}
