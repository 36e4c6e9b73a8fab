//! The sensor, and the grid of its pixels.

use glam::{DVec2, UVec2, dvec2};
use protocol::PinholeCamera;

use crate::drawing::canvas::Canvas;
use crate::drawing::ink::LineStyle;
use crate::drawing::window::{Panel, Window};

/// The rectangle at z = -1, and the pixels that divide it.
pub(super) struct Sensor {
    pub(super) size: DVec2,
    pub(super) film: UVec2,
}

impl Sensor {
    /// As the task describes it. None of a camera that is none.
    pub(super) fn new(camera: &PinholeCamera) -> Option<Sensor> {
        let height = 2.0 * (0.5 * f64::from(camera.vertical_fov)).to_radians().tan();
        let size = dvec2(f64::from(camera.aspect_ratio) * height, height);
        let is_one = size.is_finite() && size.min_element() > 0.0;
        (is_one && camera.film.min_element() > 0).then_some(Sensor {
            size,
            film: camera.film,
        })
    }

    pub(super) fn pixel_size(&self) -> DVec2 {
        self.size / self.film.as_dvec2()
    }

    /// The lower left corner of a pixel.
    pub(super) fn corner(&self, pixel: DVec2) -> DVec2 {
        pixel * self.pixel_size() - 0.5 * self.size
    }
}

/// The borders between all pixels.
pub(super) fn draw_grid(canvas: &mut Canvas, window: &Window, sensor: &Sensor) {
    let half = 0.5 * sensor.size;
    let part = Panel {
        min: window.to_page(dvec2(-half.x, half.y)),
        max: window.to_page(dvec2(half.x, -half.y)),
    };
    draw_grid_in(canvas, part, window, sensor);
}

/// The borders between pixels, as far as they are in this part of the page.
pub(super) fn draw_grid_in(canvas: &mut Canvas, part: Panel, window: &Window, sensor: &Sensor) {
    /// More lines than that are no grid.
    const MAX_LINES: f64 = 80.0;

    let half = 0.5 * sensor.size;
    let (low, high) = (window.to_page(-half), window.to_page(half));
    let min = dvec2(low.x, high.y).max(part.min);
    let max = dvec2(high.x, low.y).min(part.max);
    let step = window.to_page(sensor.pixel_size()) - window.to_page(DVec2::ZERO);
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
