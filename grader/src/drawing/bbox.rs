//! A ray and a box: in the plane of the two axes that decide, and as the times between the planes
//! of each axis, which the exam tells.

use glam::{DVec2, DVec3, Vec3, dvec2};
use protocol::{Answer, ElementOutcome, Interval, Ray};

use super::Drawing;
use super::bars::{self, BarRow, BarStyle};
use super::canvas::{Canvas, Mark};
use super::ink::{Fill, Ink, LineStyle};
use super::sheet::{Sheet, Symbol};
use super::sphere;
use super::window::Window;
use crate::describe;
use crate::drawing_data::DrawingData;

/// One shot at a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxQuery {
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
type SpanAnswer = Option<Option<Interval>>;

const AXIS_NAMES: [&str; 3] = ["x", "y", "z"];

/// The drawing.
pub(super) fn draw(shot: &BoxQuery, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    let [min, max] = shot.corners.map(|corner| corner.as_dvec3());
    let ray = &shot.ray;
    if !(min.is_finite() && max.is_finite() && ray.origin.is_finite() && ray.dir.is_finite()) {
        return None;
    }
    let got = span_answer(element, answer);
    let (a, b) = deciding_axes(shot);
    let plane = Plane { a, b };

    let mut sheet = Sheet::default();
    sheet.title(&format!(
        "along {}: {} to the right, {} up",
        AXIS_NAMES[3 - a - b],
        AXIS_NAMES[a],
        AXIS_NAMES[b]
    ));
    draw_picture(&mut sheet, shot, got, plane);
    let rows = rows(shot, got);
    sheet.y = bars::draw(&mut sheet.canvas, sheet.y, &rows, axis_distances(shot, got));
    draw_legend(&mut sheet, shot, got);
    let title = "The ray, the box, and the times between its planes";
    Some(sheet.finish(title, caption(shot, got)))
}

fn span_answer(element: usize, answer: Option<&Answer>) -> SpanAnswer {
    let outcome = match answer {
        Some(Answer::Spans(spans)) => spans.get(element),
        Some(
            Answer::Rays(_) | Answer::Hits(_) | Answer::Tree(_) | Answer::Picture(_) | Answer::Done,
        )
        | None => None,
    };
    match outcome {
        Some(ElementOutcome::Value(span)) => Some(*span),
        Some(ElementOutcome::Panicked(_) | ElementOutcome::Skipped) | None => None,
    }
}

/// The two axes that decide: the one whose planes the ray comes between last, and the one that it
/// leaves first. In their plane a hit looks like one, and a miss like one.
fn deciding_axes(shot: &BoxQuery) -> (usize, usize) {
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
    fn project(self, point: DVec3) -> DVec2 {
        dvec2(point[self.a], point[self.b])
    }
}

fn draw_picture(sheet: &mut Sheet, shot: &BoxQuery, got: SpanAnswer, plane: Plane) {
    let (origin, dir) = (shot.ray.origin.as_dvec3(), shot.ray.dir.as_dvec3());
    let at = |t: f32| plane.project(origin + f64::from(t) * dir);
    let corners = shot.corners.map(|corner| plane.project(corner.as_dvec3()));
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
    let others = others.into_iter().chain([plane.project(origin)]);
    let seen: Vec<DVec2> = corners.into_iter().chain(others.filter(is_near)).collect();
    let part = sheet.panel(sphere::panel_height(&seen));
    let window = Window::around(part, seen);

    let canvas = &mut sheet.canvas;
    let (low, high) = (window.to_page(corners[0]), window.to_page(corners[1]));
    // A flat box is seen as well.
    canvas.rectangle(low, high, LineStyle::Outline, Fill::Tint(Ink::Text, 0.08));
    draw_ray(canvas, &window, shot, plane);
    if let Some(span) = shot.wanted {
        draw_segment(
            canvas,
            &window,
            [span.min, span.max].map(at),
            LineStyle::Right,
        );
    }
    if let Some(span) = got.flatten() {
        draw_segment(
            canvas,
            &window,
            [span.min, span.max].map(at),
            LineStyle::Wrong,
        );
    }
    for (span, mark) in [(shot.wanted, Mark::Right), (got.flatten(), Mark::Wrong)] {
        for end in ends(span) {
            if let Some((at, false)) = window.pin_to_border(end) {
                canvas.mark(at, mark);
            }
        }
    }
}

fn draw_ray(canvas: &mut Canvas, window: &Window, shot: &BoxQuery, plane: Plane) {
    const FAR: f64 = 1e6;

    let (origin, dir) = (shot.ray.origin.as_dvec3(), shot.ray.dir.as_dvec3());
    let at = |t: f64| plane.project(origin + t.clamp(-FAR, FAR) * dir);
    let times = [shot.times.min, shot.times.max].map(|t| at(t.into()));
    draw_segment(canvas, window, times, LineStyle::Range);
    draw_segment(canvas, window, [at(-FAR), at(0.0)], LineStyle::Behind);
    draw_segment(canvas, window, [at(0.0), at(FAR)], LineStyle::Ray);
    if let Some((start, false)) = window.pin_to_border(at(0.0)) {
        canvas.mark(start, Mark::Origin);
    }
}

fn draw_segment(canvas: &mut Canvas, window: &Window, ends: [DVec2; 2], line: LineStyle) {
    if let Some((from, to)) = window.clip_segment(ends[0], ends[1]) {
        canvas.line(from, to, line);
    }
}

fn rows(shot: &BoxQuery, got: SpanAnswer) -> Vec<BarRow> {
    let row = |name, bar, span, otherwise: &str| BarRow {
        name,
        style: bar,
        span,
        empty_text: otherwise.to_owned(),
    };
    let slabs = shot.slabs.into_iter().flatten().zip(AXIS_NAMES);
    let mut rows: Vec<BarRow> = slabs
        .map(|(slab, name)| {
            row(
                name,
                BarStyle::Plain,
                Some(slab),
                "never between these planes",
            )
        })
        .collect();
    rows.push(row("times", BarStyle::Range, Some(shot.times), "none"));
    rows.push(row("wanted", BarStyle::Right, shot.wanted, "None"));
    let otherwise = match got {
        None => "no answer".to_owned(),
        Some(span) => describe::span(span),
    };
    rows.push(row("got", BarStyle::Wrong, got.flatten(), &otherwise));
    rows
}

/// The distances that matter: of the planes those that the ray comes between last and leaves first.
fn axis_distances(shot: &BoxQuery, got: SpanAnswer) -> Vec<f64> {
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

fn draw_legend(sheet: &mut Sheet, shot: &BoxQuery, got: SpanAnswer) {
    let wanted = format!("wanted: {}", describe::span(shot.wanted));
    let sign = |span: Option<Interval>, mark| match span {
        Some(_) => Symbol::Mark(mark),
        None => Symbol::None,
    };
    sheet.add_legend(sign(shot.wanted, Mark::Right), &wanted);
    if let Some(span) = got {
        let words = format!("got: {}", describe::span(span));
        sheet.add_legend(sign(span, Mark::Wrong), &words);
    }
    let times = format!("times: {}", describe::interval(shot.times));
    sheet.add_legend(Symbol::Line(LineStyle::Range), &times);
    let start = format!("the ray starts at {}", describe::point(shot.ray.origin));
    sheet.add_legend(Symbol::Mark(Mark::Origin), &start);
    if shot.slabs.is_some() {
        let fill = Fill::Tint(Ink::Text, 0.18);
        sheet.add_legend(
            Symbol::Area(fill),
            "when the ray is between the planes of x, y, z",
        );
    }
}

fn caption(shot: &BoxQuery, got: SpanAnswer) -> String {
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
pub(super) fn slabs(shown: &DrawingData, element: usize) -> Option<[Interval; 3]> {
    match shown {
        DrawingData::Slabs(slabs) => slabs.get(element).copied(),
        DrawingData::None | DrawingData::Traversals(_) | DrawingData::Sweep(_) => None,
    }
}
