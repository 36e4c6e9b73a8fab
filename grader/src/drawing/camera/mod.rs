//! A camera ray. The drawing shows where the ray goes through the sensor. If its direction is
//! right, the drawing shows its origin, length and range from the side instead.

mod front;
mod sensor;
mod side;

use glam::{DVec2, DVec3};
use protocol::{PinholeCamera, Ray, Sample};

use super::Drawing;

use sensor::Sensor;

/// Draws the ray of one sample of a camera, whose expected direction is `wanted`.
pub(super) fn draw(
    camera: &PinholeCamera,
    sample: Sample,
    wanted: DVec3,
    got: Option<Ray>,
) -> Option<Drawing> {
    let sensor = Sensor::new(camera)?;
    let crossing = sensor_crossing(wanted)?;
    Some(match got.filter(|ray| is_direction_right(ray, wanted)) {
        Some(ray) => side::draw(&sensor, wanted, &ray),
        None => front::draw(&sensor, sample, crossing, got),
    })
}

/// Returns the point where a direction crosses the plane z = -1, or `None` if it doesn't point
/// forward.
fn sensor_crossing(dir: DVec3) -> Option<DVec2> {
    let point = dir.truncate() / -dir.z;
    (dir.z < 0.0 && point.is_finite()).then_some(point)
}

/// Returns whether a ray's direction is roughly right. This only decides which view is drawn. The
/// judge uses smaller tolerances.
fn is_direction_right(ray: &Ray, wanted: DVec3) -> bool {
    let dir = ray.dir.as_dvec3().normalize_or_zero();
    dir.distance(wanted) <= 1e-3
}
