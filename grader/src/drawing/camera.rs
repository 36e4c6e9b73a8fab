//! A ray of the camera: where it goes through the sensor; or from the side, where its start, its
//! length or its range is what is wrong.

use glam::{DVec2, DVec3, UVec2, dvec2};
use protocol::{Answer, Interval, Outcome, PinholeCamera, Ray, Sample};

use super::Drawing;
use super::bars::{self, Bar, Row};
use super::canvas::{Anchor, Canvas, Mark};
use super::ink::{Fill, Ink, Line};
use super::sheet::{Sheet, Sign};
use super::window::{Part, Window};
use super::words::short;
use crate::describe;

/// One place on a camera's film.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aim {
    /// The camera.
    pub(super) camera: PinholeCamera,
    /// The place.
    pub(super) sample: Sample,
    /// Where its ray goes.
    pub(super) wanted: DVec3,
}

/// The drawing.
pub(super) fn draw(aim: &Aim, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    let got = got(element, answer);
    let sensor = Sensor::of(&aim.camera)?;
    let wanted = crossing(aim.wanted)?;
    if let Some(ray) = got.filter(|ray| is_direction_right(ray, aim.wanted)) {
        return Some(from_the_side(aim, &ray, &sensor));
    }
    let mut sheet = Sheet::default();
    front(&mut sheet, aim, &sensor, wanted, got);
    let title = "The sensor from the front, and where the ray goes through it";
    Some(sheet.finish(title, sentence(aim, wanted, got)))
}

fn got(element: usize, answer: Option<&Answer>) -> Option<Ray> {
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
        Some(Outcome::Value(ray)) => Some(*ray),
        Some(Outcome::Panicked(_) | Outcome::GivenUp) | None => None,
    }
}

/// The rectangle at z = -1, and the pixels that divide it.
struct Sensor {
    size: DVec2,
    film: UVec2,
}

impl Sensor {
    /// As the task describes it. None of a camera that is none.
    fn of(camera: &PinholeCamera) -> Option<Sensor> {
        let height = 2.0 * (0.5 * f64::from(camera.vertical_fov)).to_radians().tan();
        let size = dvec2(f64::from(camera.aspect_ratio) * height, height);
        let is_one = size.is_finite() && size.min_element() > 0.0;
        (is_one && camera.film.min_element() > 0).then_some(Sensor {
            size,
            film: camera.film,
        })
    }

    fn pixel(&self) -> DVec2 {
        self.size / self.film.as_dvec2()
    }

    /// The lower left corner of a pixel.
    fn corner(&self, pixel: DVec2) -> DVec2 {
        pixel * self.pixel() - 0.5 * self.size
    }
}

/// Where what goes this way crosses the plane z = -1; nowhere if it does not go forward.
fn crossing(dir: DVec3) -> Option<DVec2> {
    let place = dir.truncate() / -dir.z;
    (dir.z < 0.0 && place.is_finite()).then_some(place)
}

/// Only to choose what is drawn: the judge has finer measures.
fn is_direction_right(ray: &Ray, wanted: DVec3) -> bool {
    let dir = ray.dir.as_dvec3().normalize_or_zero();
    dir.distance(wanted) <= 1e-3
}

fn front(sheet: &mut Sheet, aim: &Aim, sensor: &Sensor, wanted: DVec2, got: Option<Ray>) {
    /// Pixels smaller than this on the page can not be told apart.
    const SMALLEST: f64 = 9.0;

    let seen = got.and_then(|ray| crossing(ray.dir.as_dvec3()));
    // What is far outside of the sensor is shown at the border.
    let near = seen.filter(|at| at.abs().cmple(1.2 * sensor.size).all());
    let half = 0.5 * sensor.size;
    let whole = [-half, half].into_iter().chain(near);
    let marks = |canvas: &mut Canvas, window: &Window| {
        let marks = [(Some(wanted), Mark::Right), (seen, Mark::Wrong)];
        for (place, mark) in marks {
            if let Some((at, _)) = place.and_then(|place| window.pinned(place)) {
                canvas.mark(at, mark);
            }
        }
    };

    let height = 306.0 * sensor.size.y / sensor.size.x + 32.0;
    let part = sheet.panel(height.clamp(90.0, 200.0));
    let window = Window::around(part, whole);
    let canvas = &mut sheet.canvas;
    let (low, high) = (window.page(-half), window.page(half));
    canvas.rectangle(low, high, Line::Outline, Fill::Of(Ink::Text, 0.04));
    let pixel = window.length(sensor.pixel().min_element());
    if pixel >= SMALLEST {
        grid(canvas, &window, sensor);
    }
    asked_pixel(canvas, &window, sensor, aim.sample.pixel);
    marks(canvas, &window);

    let is_close = near.is_some_and(|at| at.distance(wanted) < 0.15 * sensor.size.max_element());
    if pixel < 2.0 * SMALLEST && is_close {
        let seen: Vec<DVec2> = cut(aim, sensor, wanted, near);
        sheet.title("the same, closer");
        let part = sheet.panel(180.0);
        let window = Window::around(part, seen);
        if window.length(sensor.pixel().min_element()) >= SMALLEST {
            grid_in(&mut sheet.canvas, part, &window, sensor);
        }
        asked_pixel(&mut sheet.canvas, &window, sensor, aim.sample.pixel);
        marks(&mut sheet.canvas, &window);
    }
    let place = |at: DVec2| format!("({}, {}, -1)", short(at.x), short(at.y));
    let words = format!("wanted: through {}", place(wanted));
    sheet.explain(Sign::Mark(Mark::Right), &words);
    match (got, seen) {
        (None, _) => {}
        (Some(_), Some(at)) => {
            let off = if near.is_some() {
                ""
            } else {
                ", off the picture"
            };
            let words = format!("got: through {}{off}", place(at));
            sheet.explain(Sign::Mark(Mark::Wrong), &words);
        }
        (Some(ray), None) => {
            let words = format!("got: toward {}", describe::point(ray.dir));
            sheet.explain(Sign::None, &words);
        }
    }
    let (pixel, film) = (aim.sample.pixel, sensor.film);
    let words = format!(
        "pixel ({}, {}) of {} × {}; offset {} in it",
        pixel.x,
        pixel.y,
        film.x,
        film.y,
        describe::uv(aim.sample.offset)
    );
    sheet.explain(Sign::Area(Fill::Of(Ink::Text, 0.35)), &words);
}

/// What is seen closer: the pixel that is asked and both places, with some room.
fn cut(aim: &Aim, sensor: &Sensor, wanted: DVec2, got: Option<DVec2>) -> Vec<DVec2> {
    let pixel = aim.sample.pixel.as_dvec2();
    let corners = [pixel, pixel + 1.0].map(|corner| sensor.corner(corner));
    let mut seen: Vec<DVec2> = corners.into_iter().chain([wanted]).chain(got).collect();
    let room = 0.7 * sensor.pixel();
    let wider: Vec<DVec2> = seen
        .iter()
        .flat_map(|at| [*at - room, *at + room])
        .collect();
    seen.extend(wider);
    seen
}

fn asked_pixel(canvas: &mut Canvas, window: &Window, sensor: &Sensor, pixel: UVec2) {
    let pixel = pixel.as_dvec2();
    let corners = [pixel, pixel + 1.0].map(|corner| window.page(sensor.corner(corner)));
    // However small, it can be found.
    let (min, max) = (corners[0].min(corners[1]), corners[0].max(corners[1]));
    let grow = (0.5 * (3.0 - (max - min))).max(DVec2::ZERO);
    canvas.area(min - grow, max + grow, Fill::Of(Ink::Text, 0.35));
}

fn grid(canvas: &mut Canvas, window: &Window, sensor: &Sensor) {
    let half = 0.5 * sensor.size;
    let part = Part {
        min: window.page(dvec2(-half.x, half.y)),
        max: window.page(dvec2(half.x, -half.y)),
    };
    grid_in(canvas, part, window, sensor);
}

/// The borders between pixels, as far as they are in this part of the page.
fn grid_in(canvas: &mut Canvas, part: Part, window: &Window, sensor: &Sensor) {
    /// More lines than that are no grid.
    const MOST: f64 = 80.0;

    let half = 0.5 * sensor.size;
    let (low, high) = (window.page(-half), window.page(half));
    let min = dvec2(low.x, high.y).max(part.min);
    let max = dvec2(high.x, low.y).min(part.max);
    let step = window.page(sensor.pixel()) - window.page(DVec2::ZERO);
    let lines = |from: f64, to: f64, start: f64, step: f64| {
        let first = ((from - start) / step).ceil().max(0.0);
        let last = ((to - start) / step).floor().min(first + MOST);
        (first as u32..=last.max(0.0) as u32).map(move |i| start + f64::from(i) * step)
    };
    for x in lines(min.x, max.x, low.x, step.x) {
        canvas.line(dvec2(x, min.y), dvec2(x, max.y), Line::Grid);
    }
    for y in lines(min.y, max.y, high.y, -step.y) {
        canvas.line(dvec2(min.x, y), dvec2(max.x, y), Line::Grid);
    }
}

fn sentence(aim: &Aim, wanted: DVec2, got: Option<Ray>) -> String {
    let Some(ray) = got else {
        return "The ray goes through the place that is asked; your code gave no answer."
            .to_owned();
    };
    let dir = ray.dir.as_dvec3();
    match crossing(dir) {
        None if dir.is_finite() && dir != DVec3::ZERO => {
            "The camera looks down -z; your ray does not go that way.".to_owned()
        }
        None => format!("{} is no direction.", describe::point(ray.dir)),
        Some(at) => {
            let Some(sensor) = Sensor::of(&aim.camera) else {
                return "Your ray goes elsewhere.".to_owned();
            };
            let off = (at - wanted) / sensor.pixel();
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

/// The camera from the side, in the plane of -z and the wanted ray.
fn from_the_side(aim: &Aim, ray: &Ray, sensor: &Sensor) -> Drawing {
    let lateral = aim.wanted.truncate().try_normalize().unwrap_or(DVec2::Y);
    let see = |point: DVec3| dvec2(-point.z, point.truncate().dot(lateral));
    let (start, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
    let tip = see(start + dir);
    let length = dir.length();
    let mut sheet = Sheet::default();
    let part = sheet.panel(170.0);
    let near = |at: &DVec2| at.length() < 4.0;
    let seen = [
        DVec2::ZERO,
        dvec2(1.3, 0.5),
        dvec2(1.0, -0.5),
        see(aim.wanted),
    ];
    let others = [tip, see(start)].into_iter().filter(near);
    let window = Window::around(part, seen.into_iter().chain(others));

    let canvas = &mut sheet.canvas;
    let half = 0.5 * sensor.size.max_element();
    if let Some((from, to)) = window.clipped(dvec2(1.0, -half), dvec2(1.0, half)) {
        canvas.line(from, to, Line::Outline);
        let at = from.max(to) + dvec2(4.0, -4.0);
        canvas.text(at, Anchor::Start, Ink::Faint, "z = -1");
    }
    arc(canvas, &window);
    let mut arrow = |from: DVec2, to: DVec2, line, ink| {
        if let Some((from, to)) = window.clipped(from, to) {
            canvas.arrow(from, to, line, ink);
        }
    };
    arrow(DVec2::ZERO, see(aim.wanted), Line::Right, Ink::Right);
    arrow(see(start), tip, Line::Wrong, Ink::Wrong);
    canvas.mark(window.page(DVec2::ZERO), Mark::Origin);
    if see(start).length() > 1e-4
        && let Some((at, _)) = window.pinned(see(start))
    {
        canvas.mark(at, Mark::Wrong);
    }
    let is_range_right = ray.range == Interval::AHEAD;
    if !is_range_right {
        sheet.y = bars::draw(
            &mut sheet.canvas,
            sheet.y,
            &ranges(ray.range),
            range_ends(ray.range),
        );
    }
    sheet.explain(
        Sign::Line(Line::Right),
        "wanted: from (0, 0, 0), length 1, range [0, ∞]",
    );
    let words = format!(
        "got: from {}, length {}, range {}",
        describe::point(ray.origin),
        describe::number(length as f32),
        describe::interval(ray.range)
    );
    sheet.explain(Sign::Line(Line::Wrong), &words);
    sheet.explain(
        Sign::Line(Line::Behind),
        "all directions of length 1 end here",
    );
    sheet.explain(Sign::Mark(Mark::Origin), "the camera, at (0, 0, 0)");
    let title = "The camera's ray from the side";
    sheet.finish(title, side_sentence(ray, length))
}

/// The unit circle, as far as it is before the camera.
fn arc(canvas: &mut Canvas, window: &Window) {
    const STEPS: i32 = 24;

    let at = |step: i32| DVec2::from_angle(f64::from(step) / f64::from(STEPS) * 1.4);
    for step in -STEPS..STEPS {
        if let Some((from, to)) = window.clipped(at(step), at(step + 1)) {
            canvas.line(from, to, Line::Behind);
        }
    }
}

fn ranges(range: Interval) -> [Row; 2] {
    let row = |name, bar, span| Row {
        name,
        bar,
        span: Some(span),
        otherwise: describe::interval(span),
    };
    [
        row("wanted", Bar::Right, Interval::AHEAD),
        row("got", Bar::Wrong, range),
    ]
}

fn range_ends(range: Interval) -> [f64; 4] {
    [0.0, 1.0, range.min.into(), range.max.into()]
}

fn side_sentence(ray: &Ray, length: f64) -> String {
    let start = ray.origin.as_dvec3().length();
    if !(start <= 1e-4) {
        let origin = describe::point(ray.origin);
        format!("Your ray goes the right way, but starts at {origin}.")
    } else if !((length - 1.0).abs() <= 1e-3) {
        let length = describe::number(length as f32);
        format!("Your ray goes the right way, but its direction has length {length}.")
    } else if ray.range != Interval::AHEAD {
        let range = describe::interval(ray.range);
        format!("Your ray goes the right way, but only {range} of it counts.")
    } else {
        "Your ray goes the right way.".to_owned()
    }
}
