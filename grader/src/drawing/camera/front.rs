//! Draws the camera's sensor from the front.

use glam::{DVec2, DVec3, UVec2, dvec2};
use judging::describe;
use protocol::{Ray, Sample};

use super::sensor_crossing;
use super::{Sensor, draw_grid};
use crate::drawing::Drawing;
use crate::drawing::canvas::{Anchor, Canvas, Mark};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::numbers::short;
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::window::Window;

/// Draws the sensor, the point where the ray should cross it, and the point where the ray actually
/// crosses it.
pub(super) fn draw(sensor: &Sensor, sample: Sample, wanted: DVec2, got: Option<Ray>) -> Drawing {
    /// The minimum size, in page units, at which individual pixels can be distinguished.
    const MIN_PIXEL: f64 = 9.0;

    let mut sheet = Sheet::default();
    let seen = got.and_then(|ray| sensor_crossing(ray.dir.as_dvec3()));
    // A point far outside the sensor is drawn at the border.
    let near = seen.filter(|at| at.abs().cmple(1.2 * sensor.size).all());
    let half = 0.5 * sensor.size;
    let whole = [-half, half].into_iter().chain(near);
    let marks = |canvas: &mut Canvas, window: &Window| {
        let marks = [(Some(wanted), Mark::Right), (seen, Mark::Wrong)];
        for (point, mark) in marks {
            canvas.mark_pinned(window, point, mark);
        }
    };

    let height = 306.0 * sensor.size.y / sensor.size.x + 32.0;
    let panel = sheet.panel(height.clamp(90.0, 200.0));
    let window = Window::around(panel, whole);
    let canvas = &mut sheet.canvas;
    let (low, high) = (window.page_position(-half), window.page_position(half));
    canvas.rectangle(low, high, LineStyle::Outline, Fill::Tint(Ink::Text, 0.04));
    let x = dvec2(high.x, low.y + 13.0);
    canvas.text(x, Anchor::End, Ink::Faint, "x →");
    let y = dvec2(low.x - 5.0, high.y + 10.0);
    canvas.text(y, Anchor::End, Ink::Faint, "y ↑");
    let pixel = window.page_length(sensor.pixel_size().min_element());
    if pixel >= MIN_PIXEL {
        draw_grid(canvas, panel, &window, sensor);
    }
    draw_sampled_pixel(canvas, &window, sensor, sample.pixel);
    marks(canvas, &window);

    let is_close = near.is_some_and(|at| at.distance(wanted) < 0.15 * sensor.size.max_element());
    if pixel < 2.0 * MIN_PIXEL && is_close {
        let seen = closeup_points(sensor, sample.pixel, wanted, near);
        sheet.title("close-up");
        let panel = sheet.panel(180.0);
        let window = Window::around(panel, seen);
        if window.page_length(sensor.pixel_size().min_element()) >= MIN_PIXEL {
            draw_grid(&mut sheet.canvas, panel, &window, sensor);
        }
        draw_sampled_pixel(&mut sheet.canvas, &window, sensor, sample.pixel);
        marks(&mut sheet.canvas, &window);
    }
    let point_text = |at: DVec2| format!("({}, {}, -1)", short(at.x), short(at.y));
    let text = format!("through {}", point_text(wanted));
    sheet.add_wanted(Symbol::Mark(Mark::Right), &text);
    match (got, seen) {
        (None, _) => {}
        (Some(_), Some(at)) => {
            let off = near.map_or(", outside the picture", |_| "");
            let text = format!("through {}{off}", point_text(at));
            sheet.add_got(Symbol::Mark(Mark::Wrong), &text);
        }
        (Some(ray), None) => {
            let text = format!("toward {}", describe::point(ray.dir));
            sheet.add_got(Symbol::None, &text);
        }
    }
    let (pixel, film) = (sample.pixel, sensor.film);
    let text = format!(
        "pixel ({}, {}) of {} × {}, offset ({}, {})",
        pixel.x,
        pixel.y,
        film.x,
        film.y,
        short(sample.offset.x.into()),
        short(sample.offset.y.into())
    );
    sheet.add_legend(Symbol::Area(Fill::Tint(Ink::Text, 0.35)), &text);
    let title = "The sensor from the front, and the point where the ray passes through it";
    sheet.finish(title, caption(sensor, wanted, got))
}

/// Returns the points that the close-up should show: the corners of the sampled pixel and the
/// expected and submitted points, with a margin.
fn closeup_points(sensor: &Sensor, pixel: UVec2, wanted: DVec2, got: Option<DVec2>) -> Vec<DVec2> {
    let corners = sensor.pixel_corners(pixel);
    let seen = corners.into_iter().chain([wanted]).chain(got);
    let margin = 0.7 * sensor.pixel_size();
    seen.flat_map(|at| [at - margin, at + margin]).collect()
}

fn draw_sampled_pixel(canvas: &mut Canvas, window: &Window, sensor: &Sensor, pixel: UVec2) {
    let corners = sensor.pixel_corners(pixel);
    let corners = corners.map(|corner| window.page_position(corner));
    // A minimum size keeps a tiny pixel visible.
    let (min, max) = (corners[0].min(corners[1]), corners[0].max(corners[1]));
    let grow = (0.5 * (3.0 - (max - min))).max(DVec2::ZERO);
    canvas.area(min - grow, max + grow, Fill::Tint(Ink::Text, 0.35));
}

fn caption(sensor: &Sensor, wanted: DVec2, got: Option<Ray>) -> String {
    let Some(ray) = got else {
        return "The ray should pass through the marked point; your code gave no answer."
            .to_owned();
    };
    let dir = ray.dir.as_dvec3();
    match sensor_crossing(dir) {
        None if dir.is_finite() && dir != DVec3::ZERO => {
            "The camera looks down -z, but your ray points in a different direction.".to_owned()
        }
        None => format!("{} is not a direction.", describe::point(ray.dir)),
        Some(at) => {
            let off = (at - wanted) / sensor.pixel_size();
            let part = |off: f64, [before, after]: [&str; 2]| {
                let direction = if off < 0.0 { before } else { after };
                let length = short(off.abs());
                let unit = if length == "1" { "pixel" } else { "pixels" };
                (off.abs() >= 0.005).then(|| format!("{length} {unit} {direction}"))
            };
            let parts = [
                part(off.x, ["to the left", "to the right"]),
                part(off.y, ["downwards", "upwards"]),
            ];
            let parts: Vec<String> = parts.into_iter().flatten().collect();
            if parts.is_empty() {
                "Your ray is off by less than 1/100 of a pixel.".to_owned()
            } else {
                format!("Your ray is off by {}.", parts.join(" and "))
            }
        }
    }
}
