//! The sensor from the front.

use glam::{DVec2, DVec3, UVec2, dvec2};
use protocol::Ray;

use super::sensor::{Sensor, draw_grid, draw_grid_in};
use super::{CameraQuery, sensor_crossing};
use crate::describe;
use crate::drawing::Drawing;
use crate::drawing::canvas::{Anchor, Canvas, Mark};
use crate::drawing::ink::{Fill, Ink, LineStyle};
use crate::drawing::numbers::short;
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::window::Window;

/// The drawing, given where the ray should and does go.
pub(super) fn draw(aim: &CameraQuery, sensor: &Sensor, wanted: DVec2, got: Option<Ray>) -> Drawing {
    /// Pixels smaller than this on the page can not be told apart.
    const MIN_PIXEL: f64 = 9.0;

    let mut sheet = Sheet::default();
    let seen = got.and_then(|ray| sensor_crossing(ray.dir.as_dvec3()));
    // What is far outside of the sensor is shown at the border.
    let near = seen.filter(|at| at.abs().cmple(1.2 * sensor.size).all());
    let half = 0.5 * sensor.size;
    let whole = [-half, half].into_iter().chain(near);
    let marks = |canvas: &mut Canvas, window: &Window| {
        let marks = [(Some(wanted), Mark::Right), (seen, Mark::Wrong)];
        for (place, mark) in marks {
            if let Some((at, _)) = place.and_then(|place| window.pin_to_border(place)) {
                canvas.mark(at, mark);
            }
        }
    };

    let height = 306.0 * sensor.size.y / sensor.size.x + 32.0;
    let part = sheet.panel(height.clamp(90.0, 200.0));
    let window = Window::around(part, whole);
    let canvas = &mut sheet.canvas;
    let (low, high) = (window.to_page(-half), window.to_page(half));
    canvas.rectangle(low, high, LineStyle::Outline, Fill::Tint(Ink::Text, 0.04));
    let (x, y) = (
        dvec2(high.x, low.y + 13.0),
        dvec2(low.x - 5.0, high.y + 10.0),
    );
    canvas.text(x, Anchor::End, Ink::Faint, "x →");
    canvas.text(y, Anchor::End, Ink::Faint, "y ↑");
    let pixel = window.to_page_length(sensor.pixel_size().min_element());
    if pixel >= MIN_PIXEL {
        draw_grid(canvas, &window, sensor);
    }
    draw_sampled_pixel(canvas, &window, sensor, aim.sample.pixel);
    marks(canvas, &window);

    let is_close = near.is_some_and(|at| at.distance(wanted) < 0.15 * sensor.size.max_element());
    if pixel < 2.0 * MIN_PIXEL && is_close {
        let seen: Vec<DVec2> = closeup_points(aim, sensor, wanted, near);
        sheet.title("the same, closer");
        let part = sheet.panel(180.0);
        let window = Window::around(part, seen);
        if window.to_page_length(sensor.pixel_size().min_element()) >= MIN_PIXEL {
            draw_grid_in(&mut sheet.canvas, part, &window, sensor);
        }
        draw_sampled_pixel(&mut sheet.canvas, &window, sensor, aim.sample.pixel);
        marks(&mut sheet.canvas, &window);
    }
    let place = |at: DVec2| format!("({}, {}, -1)", short(at.x), short(at.y));
    let words = format!("wanted: through {}", place(wanted));
    sheet.add_legend(Symbol::Mark(Mark::Right), &words);
    match (got, seen) {
        (None, _) => {}
        (Some(_), Some(at)) => {
            let off = if near.is_some() {
                ""
            } else {
                ", off the picture"
            };
            let words = format!("got: through {}{off}", place(at));
            sheet.add_legend(Symbol::Mark(Mark::Wrong), &words);
        }
        (Some(ray), None) => {
            let words = format!("got: toward {}", describe::point(ray.dir));
            sheet.add_legend(Symbol::None, &words);
        }
    }
    let (pixel, film) = (aim.sample.pixel, sensor.film);
    let words = format!(
        "pixel ({}, {}) of {} × {}, offset ({}, {})",
        pixel.x,
        pixel.y,
        film.x,
        film.y,
        short(aim.sample.offset.x.into()),
        short(aim.sample.offset.y.into())
    );
    sheet.add_legend(Symbol::Area(Fill::Tint(Ink::Text, 0.35)), &words);
    let title = "The sensor from the front, and where the ray goes through it";
    sheet.finish(title, caption(sensor, wanted, got))
}

/// What is seen closer: the pixel that is asked and both places, with some room.
fn closeup_points(
    aim: &CameraQuery,
    sensor: &Sensor,
    wanted: DVec2,
    got: Option<DVec2>,
) -> Vec<DVec2> {
    let pixel = aim.sample.pixel.as_dvec2();
    let corners = [pixel, pixel + 1.0].map(|corner| sensor.corner(corner));
    let mut seen: Vec<DVec2> = corners.into_iter().chain([wanted]).chain(got).collect();
    let room = 0.7 * sensor.pixel_size();
    let wider: Vec<DVec2> = seen
        .iter()
        .flat_map(|at| [*at - room, *at + room])
        .collect();
    seen.extend(wider);
    seen
}

fn draw_sampled_pixel(canvas: &mut Canvas, window: &Window, sensor: &Sensor, pixel: UVec2) {
    let pixel = pixel.as_dvec2();
    let corners = [pixel, pixel + 1.0].map(|corner| window.to_page(sensor.corner(corner)));
    // However small, it can be found.
    let (min, max) = (corners[0].min(corners[1]), corners[0].max(corners[1]));
    let grow = (0.5 * (3.0 - (max - min))).max(DVec2::ZERO);
    canvas.area(min - grow, max + grow, Fill::Tint(Ink::Text, 0.35));
}

fn caption(sensor: &Sensor, wanted: DVec2, got: Option<Ray>) -> String {
    let Some(ray) = got else {
        return "The ray goes through the place that is asked; your code gave no answer."
            .to_owned();
    };
    let dir = ray.dir.as_dvec3();
    match sensor_crossing(dir) {
        None if dir.is_finite() && dir != DVec3::ZERO => {
            "The camera looks down -z; your ray does not go that way.".to_owned()
        }
        None => format!("{} is no direction.", describe::point(ray.dir)),
        Some(at) => {
            let off = (at - wanted) / sensor.pixel_size();
            let part = |off: f64, [before, after]: [&str; 2]| match off {
                _ if off.abs() < 0.005 => None,
                _ if off < 0.0 => Some(format!("{} {before}", short(-off))),
                _ => Some(format!("{} {after}", short(off))),
            };
            let parts = [
                part(off.x, ["to the left", "to the right"]),
                part(off.y, ["too low", "too high"]),
            ];
            let parts: Vec<String> = parts.into_iter().flatten().collect();
            match parts.is_empty() {
                true => "Your ray is off by less than 1/100 of a pixel.".to_owned(),
                false => format!("Your ray is off, in pixels: {}.", parts.join(", ")),
            }
        }
    }
}
