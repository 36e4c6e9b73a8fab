//! A ray and a box: in the plane of the two axes that decide, and as the times between the planes
//! of each axis, which the exam tells.

use glam::{DVec2, DVec3, Vec3, dvec2};
use protocol::{Answer, Interval, Outcome, Ray};

use super::Drawing;
use super::bars::{self, Bar, Row};
use super::canvas::{Canvas, Mark};
use super::ink::{Fill, Ink, Line};
use super::sheet::{Sheet, Sign};
use super::sphere;
use super::window::Window;
use crate::describe;
use crate::shown::Shown;

/// One shot at a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shot {
    /// The corners of the box.
    pub(super) corners: [Vec3; 2],
    /// The ray.
    pub(super) ray: Ray,
    /// The part of it that counts.
    pub(super) times: Interval,
    /// What is right.
    pub(super) wanted: Option<Interval>,
    /// When it is between the planes of each axis, if that is told.
    pub(super) slabs: Option<[Interval; 3]>,
}

/// What came: an interval, none, or no answer.
type Got = Option<Option<Interval>>;

const NAMES: [&str; 3] = ["x", "y", "z"];

/// The drawing.
pub(super) fn draw(shot: &Shot, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    let [min, max] = shot.corners.map(|corner| corner.as_dvec3());
    let ray = &shot.ray;
    if !(min.is_finite() && max.is_finite() && ray.origin.is_finite() && ray.dir.is_finite()) {
        return None;
    }
    let got = got(element, answer);
    let (a, b) = plane(shot);
    let plane = Plane { a, b };

    let mut sheet = Sheet::default();
    sheet.title(&format!(
        "along {}: {} to the right, {} up",
        NAMES[3 - a - b],
        NAMES[a],
        NAMES[b]
    ));
    picture(&mut sheet, shot, got, plane);
    let rows = rows(shot, got);
    sheet.y = bars::draw(&mut sheet.canvas, sheet.y, &rows, to_be_seen(shot, got));
    explain(&mut sheet, shot, got);
    let title = "The ray, the box, and the times between its planes";
    Some(sheet.finish(title, sentence(shot, got)))
}

fn got(element: usize, answer: Option<&Answer>) -> Got {
    let outcome = match answer {
        Some(Answer::Spans(spans)) => spans.get(element),
        Some(
            Answer::Rays(_) | Answer::Hits(_) | Answer::Tree(_) | Answer::Picture(_) | Answer::Done,
        )
        | None => None,
    };
    match outcome {
        Some(Outcome::Value(span)) => Some(*span),
        Some(Outcome::Panicked(_) | Outcome::GivenUp) | None => None,
    }
}

/// The two axes that decide: the one whose planes the ray comes between last, and the one that it
/// leaves first. In their plane a hit looks like one, and a miss like one.
fn plane(shot: &Shot) -> (usize, usize) {
    let Some(slabs) = shot.slabs else {
        // Across the axis along which the ray goes least.
        let along = shot.ray.dir.abs();
        let least = (0..3).min_by(|&a, &b| along[a].total_cmp(&along[b]));
        let least = least.unwrap_or(2);
        return in_order((least + 1) % 3, (least + 2) % 3);
    };
    let last_in = (0..3).max_by(|&a, &b| slabs[a].min.total_cmp(&slabs[b].min));
    let last_in = last_in.unwrap_or(0);
    let others = [(last_in + 1) % 3, (last_in + 2) % 3];
    let [p, q] = others;
    // The axis that comes in last may go out first as well: then the other that does.
    let first_out = if slabs[p].max <= slabs[q].max { p } else { q };
    in_order(last_in, first_out)
}

fn in_order(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

/// The plane of two axes.
#[derive(Clone, Copy)]
struct Plane {
    a: usize,
    b: usize,
}

impl Plane {
    fn see(self, point: DVec3) -> DVec2 {
        dvec2(point[self.a], point[self.b])
    }
}

fn picture(sheet: &mut Sheet, shot: &Shot, got: Got, plane: Plane) {
    let (origin, dir) = (shot.ray.origin.as_dvec3(), shot.ray.dir.as_dvec3());
    let at = |t: f32| plane.see(origin + f64::from(t) * dir);
    let corners = shot.corners.map(|corner| plane.see(corner.as_dvec3()));
    let size = corners[0].distance(corners[1]).max(1e-9);
    let middle = 0.5 * (corners[0] + corners[1]);
    let ends = |span: Option<Interval>| {
        let ends = span.map_or([f32::NAN; 2], |span| [span.min, span.max]);
        ends.map(at)
    };
    let is_near = |at: &DVec2| at.distance(middle) < 4.0 * size;
    let others = [
        ends(shot.wanted),
        ends(got.flatten()),
        ends(Some(shot.times)),
    ]
    .concat();
    let others = others.into_iter().chain([plane.see(origin)]);
    let seen: Vec<DVec2> = corners.into_iter().chain(others.filter(is_near)).collect();
    let part = sheet.panel(sphere::height(&seen));
    let window = Window::around(part, seen);

    let canvas = &mut sheet.canvas;
    let (low, high) = (window.page(corners[0]), window.page(corners[1]));
    // A flat box is seen as well.
    canvas.rectangle(low, high, Line::Outline, Fill::Of(Ink::Text, 0.08));
    ray(canvas, &window, shot, plane);
    if let Some(span) = shot.wanted {
        segment(canvas, &window, [span.min, span.max].map(at), Line::Right);
    }
    if let Some(span) = got.flatten() {
        segment(canvas, &window, [span.min, span.max].map(at), Line::Wrong);
    }
    for (span, mark) in [(shot.wanted, Mark::Right), (got.flatten(), Mark::Wrong)] {
        for end in ends(span) {
            if let Some((at, false)) = window.pinned(end) {
                canvas.mark(at, mark);
            }
        }
    }
}

fn ray(canvas: &mut Canvas, window: &Window, shot: &Shot, plane: Plane) {
    const FAR: f64 = 1e6;

    let (origin, dir) = (shot.ray.origin.as_dvec3(), shot.ray.dir.as_dvec3());
    let at = |t: f64| plane.see(origin + t.clamp(-FAR, FAR) * dir);
    let times = [shot.times.min, shot.times.max].map(|t| at(t.into()));
    segment(canvas, window, times, Line::Range);
    segment(canvas, window, [at(-FAR), at(0.0)], Line::Behind);
    segment(canvas, window, [at(0.0), at(FAR)], Line::Ray);
    if let Some((start, false)) = window.pinned(at(0.0)) {
        canvas.mark(start, Mark::Origin);
    }
}

fn segment(canvas: &mut Canvas, window: &Window, ends: [DVec2; 2], line: Line) {
    if let Some((from, to)) = window.clipped(ends[0], ends[1]) {
        canvas.line(from, to, line);
    }
}

fn rows(shot: &Shot, got: Got) -> Vec<Row> {
    let row = |name, bar, span, otherwise: &str| Row {
        name,
        bar,
        span,
        otherwise: otherwise.to_owned(),
    };
    let slabs = shot.slabs.into_iter().flatten().zip(NAMES);
    let mut rows: Vec<Row> = slabs
        .map(|(slab, name)| row(name, Bar::Plain, Some(slab), "never between these planes"))
        .collect();
    rows.push(row("times", Bar::Range, Some(shot.times), "none"));
    rows.push(row("wanted", Bar::Right, shot.wanted, "None"));
    let otherwise = match got {
        None => "no answer".to_owned(),
        Some(span) => describe::span(span),
    };
    rows.push(row("got", Bar::Wrong, got.flatten(), &otherwise));
    rows
}

/// The distances that matter: of the planes those that the ray comes between last and leaves first.
fn to_be_seen(shot: &Shot, got: Got) -> Vec<f64> {
    let ends = |span: Interval| [f64::from(span.min), f64::from(span.max)];
    let mut seen: Vec<f64> = [shot.wanted, Some(shot.times)]
        .into_iter()
        .flatten()
        .flat_map(ends)
        .collect();
    seen.push(0.0);
    if let Some(slabs) = shot.slabs {
        let finite = |t: &f64| t.is_finite();
        let last_in = slabs.iter().map(|slab| slab.min.into()).filter(finite);
        let first_out = slabs.iter().map(|slab| slab.max.into()).filter(finite);
        seen.extend(last_in.reduce(f64::max));
        seen.extend(first_out.reduce(f64::min));
    }
    let finite = seen.iter().copied().filter(|t| t.is_finite());
    let reach = 8.0 * finite.fold(1e-3_f64, |reach, t| reach.max(t.abs()));
    let got = got.flatten().map(ends).into_iter().flatten();
    seen.extend(got.filter(|t| t.abs() < reach));
    seen
}

fn explain(sheet: &mut Sheet, shot: &Shot, got: Got) {
    let wanted = format!("wanted: {}", describe::span(shot.wanted));
    let sign = |span: Option<Interval>, mark| match span {
        Some(_) => Sign::Mark(mark),
        None => Sign::None,
    };
    sheet.explain(sign(shot.wanted, Mark::Right), &wanted);
    if let Some(span) = got {
        let words = format!("got: {}", describe::span(span));
        sheet.explain(sign(span, Mark::Wrong), &words);
    }
    let times = format!("times: {}", describe::interval(shot.times));
    sheet.explain(Sign::Line(Line::Range), &times);
    let start = format!("the ray starts at {}", describe::point(shot.ray.origin));
    sheet.explain(Sign::Mark(Mark::Origin), &start);
    if shot.slabs.is_some() {
        let fill = Fill::Of(Ink::Text, 0.18);
        sheet.explain(
            Sign::Area(fill),
            "when the ray is between the planes of x, y, z",
        );
    }
}

fn sentence(shot: &Shot, got: Got) -> String {
    let wanted = describe::span(shot.wanted);
    match (shot.wanted, got) {
        (_, None) => format!("Right is {wanted}; your code gave no answer."),
        (Some(_), Some(None)) => {
            format!("All bars overlap in {wanted}, the times in the box; you answer None.")
        }
        (Some(_), Some(Some(span))) => format!(
            "All bars overlap in {wanted}, the times in the box; you answer {}.",
            describe::interval(span)
        ),
        (None, Some(Some(span))) => format!(
            "The bars have no time in common, so right is None; you answer {}.",
            describe::interval(span)
        ),
        (None, Some(None)) => "Right is None.".to_owned(),
    }
}

/// The slabs of one shot, if the exam tells them.
pub(super) fn slabs(shown: &Shown, element: usize) -> Option<[Interval; 3]> {
    match shown {
        Shown::Slabs(slabs) => slabs.get(element).copied(),
        Shown::Nothing | Shown::Walks(_) | Shown::Sweep(_) => None,
    }
}
