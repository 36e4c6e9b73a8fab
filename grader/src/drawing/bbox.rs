//! A ray and a box, drawn in two ways: in the plane of the two axes that decide whether the ray
//! hits, and as the intervals in which the ray is between the two planes of each axis. The exam
//! stores these intervals.

use glam::{DVec2, DVec3, Vec3, dvec2};
use judging::describe;
use judging::drawing_data::DrawingData;
use protocol::{Answer, ElementOutcome, Interval, Ray};

use super::Drawing;
use super::bars::{self, BarRow, BarStyle};
use super::canvas::{Canvas, Mark};
use super::ink::{Fill, Ink, LineStyle};
use super::sheet::{Sheet, Symbol};
use super::sphere;
use super::window::Window;

/// A question about one ray and one box.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxQuery {
    /// The minimum and maximum corner of the box.
    pub(super) corners: [Vec3; 2],
    /// The ray that is tested against the box.
    pub(super) ray: Ray,
    /// The interval that the result is clipped to.
    pub(super) times: Interval,
    /// The expected result: the part of `times` in which the ray is in the box.
    pub(super) wanted: Option<Interval>,
    /// For each axis, the interval in which the ray is between the two planes, if the exam stores
    /// these intervals.
    pub(super) slabs: Option<[Interval; 3]>,
}

/// The submission's answer: an interval, `None`, or no answer at all.
type SpanAnswer = Option<Option<Interval>>;

const AXIS_NAMES: [&str; 3] = ["x", "y", "z"];

/// Draws the ray and the box of a query.
pub(super) fn draw(query: &BoxQuery, element: usize, answer: Option<&Answer>) -> Option<Drawing> {
    let [min, max] = query.corners.map(|corner| corner.as_dvec3());
    let ray = &query.ray;
    if !(min.is_finite() && max.is_finite() && ray.origin.is_finite() && ray.dir.is_finite()) {
        return None;
    }
    let got = span_answer(element, answer);
    let (a, b) = deciding_axes(query);
    let plane = Plane { a, b };

    let mut sheet = Sheet::default();
    sheet.title(&format!(
        "along {}: {} to the right, {} up",
        AXIS_NAMES[3 - a - b],
        AXIS_NAMES[a],
        AXIS_NAMES[b]
    ));
    draw_picture(&mut sheet, query, got, plane);
    let rows = rows(query, got);
    sheet.y = bars::draw(
        &mut sheet.canvas,
        sheet.y,
        &rows,
        axis_distances(query, got),
    );
    draw_legend(&mut sheet, query, got);
    let title = "The ray, the box, and the times between its planes";
    Some(sheet.finish(title, caption(query, got)))
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

/// Returns the two axes that decide whether the ray hits: the one whose slab it enters last, and
/// the one whose slab it leaves first. In the plane of these axes, a hit looks like a hit and a
/// miss like a miss.
fn deciding_axes(query: &BoxQuery) -> (usize, usize) {
    let Some(slabs) = query.slabs else {
        // If the exam has no slabs, look along the axis in which the ray's direction has the
        // smallest component.
        let along = query.ray.dir.abs();
        let least = (0..3).min_by(|&a, &b| along[a].total_cmp(&along[b]));
        let least = least.unwrap_or(2);
        return in_order((least + 1) % 3, (least + 2) % 3);
    };
    let last_in = (0..3).max_by(|&a, &b| slabs[a].min.total_cmp(&slabs[b].min));
    let last_in = last_in.unwrap_or(0);
    let others = [(last_in + 1) % 3, (last_in + 2) % 3];
    let [p, q] = others;
    // If the slab that the ray enters last is also the one that it leaves first, the second axis is
    // the one whose slab it leaves next.
    let first_out = if slabs[p].max <= slabs[q].max { p } else { q };
    in_order(last_in, first_out)
}

fn in_order(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

/// The plane spanned by two axes.
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

fn draw_picture(sheet: &mut Sheet, query: &BoxQuery, got: SpanAnswer, plane: Plane) {
    let (origin, dir) = (query.ray.origin.as_dvec3(), query.ray.dir.as_dvec3());
    let at = |t: f32| plane.project(origin + f64::from(t) * dir);
    let corners = query.corners.map(|corner| plane.project(corner.as_dvec3()));
    let size = corners[0].distance(corners[1]).max(1e-9);
    let middle = 0.5 * (corners[0] + corners[1]);
    let ends = |span: Option<Interval>| {
        let ends = span.map_or([f32::NAN; 2], |span| [span.min, span.max]);
        ends.map(at)
    };
    let is_near = |at: &DVec2| at.distance(middle) < 4.0 * size;
    let others = [
        ends(query.wanted),
        ends(got.flatten()),
        ends(Some(query.times)),
    ]
    .concat();
    let others = others.into_iter().chain([plane.project(origin)]);
    let seen: Vec<DVec2> = corners.into_iter().chain(others.filter(is_near)).collect();
    let panel = sheet.panel(sphere::panel_height(&seen));
    let window = Window::around(panel, seen);

    let canvas = &mut sheet.canvas;
    let (low, high) = (
        window.page_position(corners[0]),
        window.page_position(corners[1]),
    );
    // An outline makes a flat box visible.
    canvas.rectangle(low, high, LineStyle::Outline, Fill::Tint(Ink::Text, 0.08));
    draw_ray(canvas, &window, query, plane);
    if let Some(span) = query.wanted {
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
    for (span, mark) in [(query.wanted, Mark::Right), (got.flatten(), Mark::Wrong)] {
        for end in ends(span) {
            if let Some((at, false)) = window.pin_to_border(end) {
                canvas.mark(at, mark);
            }
        }
    }
}

fn draw_ray(canvas: &mut Canvas, window: &Window, query: &BoxQuery, plane: Plane) {
    const FAR: f64 = 1e6;

    let (origin, dir) = (query.ray.origin.as_dvec3(), query.ray.dir.as_dvec3());
    let at = |t: f64| plane.project(origin + t.clamp(-FAR, FAR) * dir);
    let times = [query.times.min, query.times.max].map(|t| at(t.into()));
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

fn rows(query: &BoxQuery, got: SpanAnswer) -> Vec<BarRow> {
    let row = |name, style, span, empty_text: &str| BarRow {
        name,
        style,
        span,
        empty_text: empty_text.to_owned(),
    };
    let slabs = query.slabs.into_iter().flatten().zip(AXIS_NAMES);
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
    rows.push(row("times", BarStyle::Range, Some(query.times), "none"));
    rows.push(row("wanted", BarStyle::Right, query.wanted, "None"));
    let got_text = match got {
        None => "no answer".to_owned(),
        Some(span) => describe::span(span),
    };
    rows.push(row("got", BarStyle::Wrong, got.flatten(), &got_text));
    rows
}

/// Returns the distances that the axis must cover. The slabs contribute only the last entry and the
/// first exit.
fn axis_distances(query: &BoxQuery, got: SpanAnswer) -> Vec<f64> {
    let ends = |span: Interval| [f64::from(span.min), f64::from(span.max)];
    let mut seen: Vec<f64> = [query.wanted, Some(query.times)]
        .into_iter()
        .flatten()
        .flat_map(ends)
        .collect();
    seen.push(0.0);
    if let Some(slabs) = query.slabs {
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

fn draw_legend(sheet: &mut Sheet, query: &BoxQuery, got: SpanAnswer) {
    let wanted = format!("wanted: {}", describe::span(query.wanted));
    let symbol = |span: Option<Interval>, mark| match span {
        Some(_) => Symbol::Mark(mark),
        None => Symbol::None,
    };
    sheet.add_legend(symbol(query.wanted, Mark::Right), &wanted);
    if let Some(span) = got {
        let text = format!("got: {}", describe::span(span));
        sheet.add_legend(symbol(span, Mark::Wrong), &text);
    }
    let times = format!("times: {}", describe::interval(query.times));
    sheet.add_legend(Symbol::Line(LineStyle::Range), &times);
    let start = format!("the ray starts at {}", describe::point(query.ray.origin));
    sheet.add_legend(Symbol::Mark(Mark::Origin), &start);
    if query.slabs.is_some() {
        let fill = Fill::Tint(Ink::Text, 0.18);
        sheet.add_legend(
            Symbol::Area(fill),
            "when the ray is between the planes of x, y, z",
        );
    }
}

fn caption(query: &BoxQuery, got: SpanAnswer) -> String {
    let wanted = describe::span(query.wanted);
    match (query.wanted, got) {
        (_, None) => format!("The correct answer is {wanted}; your code gave no answer."),
        (Some(_), Some(None)) => {
            format!("All bars overlap in {wanted}: the ray is in the box then. You answered None.")
        }
        (Some(_), Some(Some(span))) => format!(
            "All bars overlap in {wanted}: the ray is in the box then. You answered {}.",
            describe::interval(span)
        ),
        (None, Some(Some(span))) => format!(
            "The bars never all overlap, so the correct answer is None. You answered {}.",
            describe::interval(span)
        ),
        (None, Some(None)) => "The correct answer is None.".to_owned(),
    }
}

/// Returns the slabs of one query, if the exam has them.
pub(super) fn slabs(data: &DrawingData, element: usize) -> Option<[Interval; 3]> {
    match data {
        DrawingData::Slabs(slabs) => slabs.get(element).copied(),
        DrawingData::None | DrawingData::Traversals(_) | DrawingData::Sweep(_) => None,
    }
}
