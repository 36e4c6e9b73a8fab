//! Draws a ray and a box in two ways: in the plane spanned by the two axes that decide whether the
//! ray hits, and as bars. For each axis, a bar shows the interval during which the ray is between
//! the box's two planes. The exam stores these intervals.

use glam::{DVec2, Vec3};
use judging::describe;
use protocol::{Interval, Ray};

use super::Drawing;
use super::bars::{self, BarRow, BarStyle};
use super::canvas::Mark;
use super::ink::{Fill, Ink, LineStyle};
use super::plane::{AXIS_NAMES, Plane};
use super::sheet::{Sheet, Symbol};

/// A question about one ray and one box.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxQuery {
    /// The minimum and maximum corners of the box.
    pub(super) corners: [Vec3; 2],
    /// The ray that is tested against the box.
    pub(super) ray: Ray,
    /// The interval that the result is clipped to.
    pub(super) times: Interval,
    /// The expected result: the part of `times` where the ray is inside the box.
    pub(super) wanted: Option<Interval>,
    /// The submission's answer: an interval, `None`, or no answer at all.
    pub(super) got: Option<Option<Interval>>,
    /// For each axis, the interval where the ray is between the two planes, if the exam stores
    /// these intervals.
    pub(super) slabs: Option<[Interval; 3]>,
}

/// Draws the ray and the box of a query.
pub(super) fn draw(query: &BoxQuery) -> Option<Drawing> {
    let [min, max] = query.corners.map(|corner| corner.as_dvec3());
    let ray = &query.ray;
    if !(min.is_finite() && max.is_finite() && ray.origin.is_finite() && ray.dir.is_finite()) {
        return None;
    }
    let plane = deciding_plane(query);
    let mut sheet = Sheet::default();
    let along = AXIS_NAMES[plane.normal_axis()];
    sheet.title(&format!("along {along}: {}", plane.name()));
    draw_picture(&mut sheet, query, plane);
    let rows = rows(query);
    bars::draw(&mut sheet, &rows, axis_distances(query));
    draw_legend(&mut sheet, query);
    let title = "The ray, the box, and the times when the ray is between the box's planes";
    Some(sheet.finish(title, caption(query)))
}

/// Returns the plane spanned by the two axes that decide whether the ray hits: the axis whose slab
/// it enters last and the axis whose slab it leaves first. In this plane, a hit looks like a hit
/// and a miss like a miss.
fn deciding_plane(query: &BoxQuery) -> Plane {
    let Some(slabs) = query.slabs else {
        // If the exam contains no slabs, look along the axis with the smallest component of the
        // ray's direction.
        let along = query.ray.dir.abs();
        let least = (0..3).min_by(|&a, &b| along[a].total_cmp(&along[b]));
        let least = least.unwrap_or(2);
        return Plane::of((least + 1) % 3, (least + 2) % 3);
    };
    let last_in = (0..3).max_by(|&a, &b| slabs[a].min.total_cmp(&slabs[b].min));
    let last_in = last_in.unwrap_or(0);
    let others = [(last_in + 1) % 3, (last_in + 2) % 3];
    let [p, q] = others;
    // If the slab that the ray leaves first is also the one that it enters last, use the slab that
    // it leaves next for the second axis.
    let first_out = if slabs[p].max <= slabs[q].max { p } else { q };
    Plane::of(last_in, first_out)
}

fn draw_picture(sheet: &mut Sheet, query: &BoxQuery, plane: Plane) {
    let (origin, dir) = (query.ray.origin.as_dvec3(), query.ray.dir.as_dvec3());
    let along = |t: f64| plane.project(origin + t * dir);
    let corners = query.corners.map(|corner| plane.project(corner.as_dvec3()));
    let size = corners[0].distance(corners[1]).max(1e-9);
    let middle = 0.5 * (corners[0] + corners[1]);
    let ends = |span: Option<Interval>| {
        let ends = span.map_or([f32::NAN; 2], |span| [span.min, span.max]);
        ends.map(|t| along(t.into()))
    };
    let is_near = |at: &DVec2| at.distance(middle) < 4.0 * size;
    let spans = [query.wanted, query.got.flatten(), Some(query.times)];
    let others = spans.into_iter().flat_map(ends);
    let others = others.chain([plane.project(origin)]);
    let seen: Vec<DVec2> = corners.into_iter().chain(others.filter(is_near)).collect();
    let window = sheet.window(seen);
    let canvas = &mut sheet.canvas;
    let [low, high] = corners.map(|corner| window.page_position(corner));
    // An outline makes a flat box visible.
    canvas.rectangle(low, high, LineStyle::Outline, Fill::Tint(Ink::Text, 0.08));
    canvas.ray(&window, Some(query.times), 1e6, along);
    canvas.mark_inside(&window, plane.project(origin), Mark::Origin);
    let spans = [
        (query.wanted, LineStyle::Right, Mark::Right),
        (query.got.flatten(), LineStyle::Wrong, Mark::Wrong),
    ];
    for (span, line, _) in spans {
        canvas.segment(&window, ends(span), line);
    }
    for (span, _, mark) in spans {
        for end in ends(span) {
            canvas.mark_inside(&window, end, mark);
        }
    }
}

fn rows(query: &BoxQuery) -> Vec<BarRow> {
    let never = "never between these planes";
    let slabs = query.slabs.into_iter().flatten().zip(AXIS_NAMES);
    let mut rows: Vec<BarRow> = slabs
        .map(|(slab, name)| BarRow::new(name, BarStyle::Plain, Some(slab), never))
        .collect();
    let (range, times) = (BarStyle::Range, Some(query.times));
    rows.push(BarRow::new("times", range, times, "none"));
    rows.push(BarRow::new("wanted", BarStyle::Right, query.wanted, "None"));
    let got_text = match query.got {
        None => "no answer".to_owned(),
        Some(span) => describe::span(span),
    };
    let got = query.got.flatten();
    rows.push(BarRow::new("got", BarStyle::Wrong, got, &got_text));
    rows
}

/// Returns the distances that the axis must cover. The slabs only contribute the last entry and the
/// first exit.
fn axis_distances(query: &BoxQuery) -> Vec<f64> {
    let ends = |span: Interval| [f64::from(span.min), f64::from(span.max)];
    let spans = [query.wanted, Some(query.times)].into_iter().flatten();
    let mut seen: Vec<f64> = spans.flat_map(ends).collect();
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
    let got = query.got.flatten().map(ends).into_iter().flatten();
    seen.extend(got.filter(|t| t.abs() < reach));
    seen
}

fn draw_legend(sheet: &mut Sheet, query: &BoxQuery) {
    let symbol = |span: Option<Interval>, mark| match span {
        Some(_) => Symbol::Mark(mark),
        None => Symbol::None,
    };
    let wanted = describe::span(query.wanted);
    sheet.add_wanted(symbol(query.wanted, Mark::Right), &wanted);
    if let Some(span) = query.got {
        sheet.add_got(symbol(span, Mark::Wrong), &describe::span(span));
    }
    let times = format!("times: {}", describe::interval(query.times));
    sheet.add_legend(Symbol::Line(LineStyle::Range), &times);
    let start = format!("the ray starts at {}", describe::point(query.ray.origin));
    sheet.add_legend(Symbol::Mark(Mark::Origin), &start);
    if query.slabs.is_some() {
        let text = "when the ray is between the x, y and z planes";
        sheet.add_legend(Symbol::Area(Fill::Tint(Ink::Text, 0.18)), text);
    }
}

fn caption(query: &BoxQuery) -> String {
    let wanted = describe::span(query.wanted);
    match (query.wanted, query.got) {
        (_, None) => format!("The correct answer is {wanted}; your code gave no answer."),
        (Some(_), Some(None)) => {
            format!(
                "All bars overlap in {wanted}: that is when the ray is in the box. You answered None."
            )
        }
        (Some(_), Some(Some(span))) => format!(
            "All bars overlap in {wanted}: that is when the ray is in the box. You answered {}.",
            describe::interval(span)
        ),
        (None, Some(Some(span))) => format!(
            "The bars never all overlap, so the correct answer is None. You answered {}.",
            describe::interval(span)
        ),
        (None, Some(None)) => "The correct answer is None.".to_owned(),
    }
}
