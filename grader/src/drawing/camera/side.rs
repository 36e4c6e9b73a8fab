//! Draws a camera ray from the side.

use glam::{DVec2, DVec3, dvec2};
use judging::describe;
use protocol::{Interval, Ray};

use super::Sensor;
use crate::drawing::Drawing;
use crate::drawing::bars::{self, BarRow, BarStyle};
use crate::drawing::canvas::{Anchor, Canvas, Mark};
use crate::drawing::ink::{Ink, LineStyle};
use crate::drawing::sheet::{Sheet, Symbol};
use crate::drawing::window::Window;

/// Draws the submitted and the expected ray in the plane that contains the -z axis and the expected
/// ray.
pub(super) fn draw(sensor: &Sensor, wanted: DVec3, ray: &Ray) -> Drawing {
    let lateral = wanted.truncate().try_normalize().unwrap_or(DVec2::Y);
    let see = |point: DVec3| dvec2(-point.z, point.truncate().dot(lateral));
    let (start, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
    let tip = see(start + dir);
    let length = dir.length();
    let mut sheet = Sheet::default();
    let panel = sheet.panel(170.0);
    let near = |at: &DVec2| at.length() < 4.0;
    let seen = [DVec2::ZERO, dvec2(1.3, 0.5), dvec2(1.0, -0.5), see(wanted)];
    let others = [tip, see(start)].into_iter().filter(near);
    let window = Window::around(panel, seen.into_iter().chain(others));

    let canvas = &mut sheet.canvas;
    let half = 0.5 * sensor.size.max_element();
    if let Some((from, to)) = window.clip_segment(dvec2(1.0, -half), dvec2(1.0, half)) {
        canvas.line(from, to, LineStyle::Outline);
        let at = from.max(to) + dvec2(4.0, -4.0);
        canvas.text(at, Anchor::Start, Ink::Faint, "z = -1");
    }
    draw_unit_arc(canvas, &window);
    canvas.arrow(&window, [DVec2::ZERO, see(wanted)], LineStyle::Right);
    canvas.arrow(&window, [see(start), tip], LineStyle::Wrong);
    canvas.mark(window.page_position(DVec2::ZERO), Mark::Origin);
    if see(start).length() > 1e-4 {
        canvas.mark_pinned(&window, Some(see(start)), Mark::Wrong);
    }
    if ray.range != Interval::AHEAD {
        let row =
            |name, style, span| BarRow::new(name, style, Some(span), &describe::interval(span));
        let rows = [
            row("wanted", BarStyle::Right, Interval::AHEAD),
            row("got", BarStyle::Wrong, ray.range),
        ];
        let ends = [0.0, 1.0, ray.range.min.into(), ray.range.max.into()];
        bars::draw(&mut sheet, &rows, ends);
    }
    let wanted = "from (0, 0, 0), length 1, range [0, ∞]";
    sheet.add_wanted(Symbol::Line(LineStyle::Right), wanted);
    let text = format!(
        "from {}, length {}, range {}",
        describe::point(ray.origin),
        describe::number(length as f32),
        describe::interval(ray.range)
    );
    sheet.add_got(Symbol::Line(LineStyle::Wrong), &text);
    let behind = Symbol::Line(LineStyle::Behind);
    sheet.add_legend(behind, "all directions of length 1 end here");
    sheet.add_legend(Symbol::Mark(Mark::Origin), "the camera, at (0, 0, 0)");
    let title = "The camera ray, seen from the side";
    sheet.finish(title, caption(ray, length))
}

/// Draws the part of the unit circle that is in front of the camera.
fn draw_unit_arc(canvas: &mut Canvas, window: &Window) {
    const STEPS: i32 = 24;

    let at = |step: i32| DVec2::from_angle(f64::from(step) / f64::from(STEPS) * 1.4);
    for step in -STEPS..STEPS {
        canvas.segment(window, [at(step), at(step + 1)], LineStyle::Behind);
    }
}

fn caption(ray: &Ray, length: f64) -> String {
    let start = ray.origin.as_dvec3().length();
    if is_off(start, 0.0) {
        let origin = describe::point(ray.origin);
        format!("Your ray has the right direction, but starts at {origin}.")
    } else if is_off(length, 1.0) {
        let length = describe::number(length as f32);
        format!("Your direction points the right way, but has length {length}; it must be 1.")
    } else if ray.range != Interval::AHEAD {
        let range = describe::interval(ray.range);
        format!("Your ray has the right direction, but its range is {range}; it must be [0, ∞].")
    } else {
        "Your ray has the right direction.".to_owned()
    }
}

/// Returns whether a value is noticeably wrong. NaN always counts as wrong. This is only used to
/// choose the caption.
fn is_off(value: f64, wanted: f64) -> bool {
    let is_close = (value - wanted).abs() <= 1e-3;
    !is_close
}
