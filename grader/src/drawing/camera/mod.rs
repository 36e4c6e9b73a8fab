//! Draws a camera ray. If there is no ray or its direction is wrong, the drawing shows where the
//! ray goes through the sensor. Otherwise, it shows the ray's origin, length and range from the
//! side.

mod front;
mod side;

use glam::{DVec2, DVec3, UVec2, dvec2};
use protocol::{PinholeCamera, Ray, Sample};

use super::Drawing;
use super::canvas::Canvas;
use super::ink::LineStyle;
use super::window::{Panel, Window};

/// Draws a camera's ray for one sample. `wanted` is the expected direction of the ray.
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

/// Returns the point where a ray from the origin in this direction crosses the plane z = -1, or
/// `None` if the direction doesn't point forward.
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

/// The sensor, a rectangle at z = -1, with its size and its resolution in pixels.
struct Sensor {
    size: DVec2,
    film: UVec2,
}

impl Sensor {
    /// Creates a camera's sensor according to the definition in the task. Returns `None` if the
    /// sensor would be empty.
    fn new(camera: &PinholeCamera) -> Option<Sensor> {
        let height = 2.0 * (0.5 * f64::from(camera.vertical_fov)).to_radians().tan();
        let size = dvec2(f64::from(camera.aspect_ratio) * height, height);
        let is_one = size.is_finite() && size.min_element() > 0.0;
        (is_one && camera.film.min_element() > 0).then_some(Sensor {
            size,
            film: camera.film,
        })
    }

    fn pixel_size(&self) -> DVec2 {
        self.size / self.film.as_dvec2()
    }

    /// Returns the lower-left and upper-right corners of a pixel.
    fn pixel_corners(&self, pixel: UVec2) -> [DVec2; 2] {
        let pixel = pixel.as_dvec2();
        [pixel, pixel + 1.0].map(|corner| corner * self.pixel_size() - 0.5 * self.size)
    }
}

/// Draws the borders between the pixels inside a panel.
fn draw_grid(canvas: &mut Canvas, panel: Panel, window: &Window, sensor: &Sensor) {
    /// The maximum number of lines in each direction.
    const MAX_LINES: f64 = 80.0;

    let half = 0.5 * sensor.size;
    let (low, high) = (window.page_position(-half), window.page_position(half));
    let min = dvec2(low.x, high.y).max(panel.min);
    let max = dvec2(high.x, low.y).min(panel.max);
    let step = window.page_position(sensor.pixel_size()) - window.page_position(DVec2::ZERO);
    let lines = |from: f64, to: f64, start: f64, step: f64| {
        let first = ((from - start) / step).ceil().max(0.0);
        let last = ((to - start) / step).floor().min(first + MAX_LINES);
        (first as u32..=last.max(0.0) as u32).map(move |i| start + f64::from(i) * step)
    };
    for x in lines(min.x, max.x, low.x, step.x) {
        canvas.line(dvec2(x, min.y), dvec2(x, max.y), LineStyle::Grid);
    }
    for y in lines(min.y, max.y, high.y, -step.y) {
        canvas.line(dvec2(min.x, y), dvec2(max.x, y), LineStyle::Grid);
    }
}
