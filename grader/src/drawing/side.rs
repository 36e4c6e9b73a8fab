//! Draws a ray from the side: it points to the right, and distances along it are to scale.

use glam::{DVec2, DVec3, dvec2};
use judging::describe;

use super::canvas::{Canvas, Mark};
use super::hit_comparison::{DrawnHit, Focus, HitAnswer, HitComparison};
use super::ink::{Ink, LineStyle};
use super::numbers::{point, short};
use super::sheet::{Sheet, Symbol};
use super::window::{Window, extent};

/// A side view of a ray: a plane that contains the ray, oriented so that the ray points right.
#[derive(Clone, Copy, Debug)]
pub(super) struct SideView {
    origin: DVec3,
    dir: DVec3,
    up: DVec3,
}

impl SideView {
    /// Creates the plane through the ray that contains the direction `toward`. If `toward` is
    /// parallel to the ray, any plane through the ray will do.
    pub(super) fn new(comparison: &HitComparison, toward: DVec3) -> SideView {
        let dir = comparison.dir();
        let up = (toward - toward.dot(dir) * dir).try_normalize();
        SideView {
            origin: comparison.ray.origin.as_dvec3(),
            dir,
            up: up.unwrap_or_else(|| dir.any_orthonormal_vector()),
        }
    }

    /// Projects a point onto the plane.
    pub(super) fn project(&self, point: DVec3) -> DVec2 {
        self.project_vector(point - self.origin)
    }

    /// Projects a direction onto the plane.
    pub(super) fn project_vector(&self, vector: DVec3) -> DVec2 {
        dvec2(vector.dot(self.dir), vector.dot(self.up))
    }

    /// Projects a point onto the plane perpendicular to the ray, as seen along the ray. The ray
    /// itself is at (0, 0).
    pub(super) fn project_along_ray(&self, point: DVec3) -> DVec2 {
        let aside = point - self.origin;
        dvec2(aside.dot(self.dir.cross(self.up)), aside.dot(self.up))
    }
}

/// Returns the points that the drawing should show: the points of `shape`, the ray's origin, the
/// hits, and the ends of the ray's range. Points so far away that the shape would shrink to a dot
/// are left out.
pub(super) fn landmarks(
    comparison: &HitComparison,
    side: &SideView,
    shape: &[DVec2],
) -> Vec<DVec2> {
    /// The maximum distance from the shape, as a multiple of its size.
    const MAX_SIZES: f64 = 5.0;

    let mut seen = shape.to_vec();
    let Some((min, max)) = extent(shape.iter().copied()) else {
        return seen;
    };
    let reach = MAX_SIZES * (max - min).length().max(1e-9);
    let range = comparison.ray.range;
    let ends = [range.min, range.max].map(|end| side.project(comparison.at(end.into())));
    let hits = [
        comparison.wanted.map(|hit| side.project(hit.position)),
        comparison.got_point().map(|point| side.project(point)),
    ];
    let others = hits.into_iter().flatten().chain([DVec2::ZERO]).chain(ends);
    seen.extend(others.filter(|at| at.distance(at.clamp(min, max)) <= reach));
    seen
}

/// Draws the line of the ray, its origin, and its range if the range is limited.
pub(super) fn draw_ray(canvas: &mut Canvas, window: &Window, comparison: &HitComparison) {
    let range = comparison.limited_range();
    canvas.ray(window, range, 1e7, |t| dvec2(t, 0.0));
    // Draws ticks across the ray at the ends of the range.
    let ends = range.map_or([f32::NAN; 2], |range| [range.min, range.max]);
    for end in ends {
        if let Some((at, false)) = window.pin_to_border(dvec2(end.into(), 0.0)) {
            let half = dvec2(0.0, 9.0);
            canvas.line(at - half, at + half, LineStyle::Outline);
        }
    }
    canvas.mark_inside(window, DVec2::ZERO, Mark::Origin);
}

/// Draws the expected and the submitted hit, with the field that is in focus.
pub(super) fn draw_hits(
    canvas: &mut Canvas,
    window: &Window,
    comparison: &HitComparison,
    side: &SideView,
) {
    /// The length of the arrow for a unit normal, in page units.
    const ARROW: f64 = 46.0;

    let wanted = comparison.wanted.map(|hit| side.project(hit.position));
    let got = comparison.got_point().map(|point| side.project(point));
    if let (Focus::Normal, Some(wanted), HitAnswer::Hit(hit)) =
        (comparison.focus, comparison.wanted, comparison.got)
    {
        let foot = side.project(wanted.position);
        let mut arrow = |normal: DVec3, aside: f64, line: LineStyle, ink: Ink| {
            let length = normal.length().clamp(0.4, 1.6) / normal.length();
            let seen = side.project_vector(normal);
            let foot = foot + window.world_length(aside) * seen.perp().normalize_or_zero();
            let tip = foot + window.world_length(ARROW) * length * seen;
            if let Some((foot, tip)) = window.clip_segment(foot, tip) {
                canvas.arrow(foot, tip, line, ink);
            }
        };
        // Arrows that would cover each other are drawn side by side.
        let is_same_way = wanted.normal.angle_between(hit.normal) < 0.15;
        let aside = if is_same_way { 6.0 } else { 0.0 };
        arrow(wanted.normal, 0.0, LineStyle::Right, Ink::Right);
        arrow(hit.normal, aside, LineStyle::Wrong, Ink::Wrong);
        canvas.mark(window.page_position(foot), Mark::Right);
        return;
    }
    canvas.mark_pinned(window, wanted, Mark::Right);
    let is_marked = match comparison.focus {
        Focus::Distance | Focus::Position => true,
        Focus::Normal | Focus::Uv | Focus::Origin | Focus::Shape => false,
    };
    canvas.mark_pinned(window, got.filter(|_| is_marked), Mark::Wrong);
    if let (Focus::Origin, HitAnswer::Hit(hit)) = (comparison.focus, comparison.got) {
        canvas.mark_pinned(window, Some(side.project(hit.origin)), Mark::Wrong);
    }
}

/// Adds the legend for the ray and both hits.
pub(super) fn draw_legend(
    sheet: &mut Sheet,
    comparison: &HitComparison,
    side: &SideView,
    window: &Window,
) {
    let got = comparison
        .got_point()
        .and_then(|point| window.pin_to_border(side.project(point)));
    let is_off = got.is_some_and(|(_, is_off)| is_off);
    let symbol = |line: LineStyle, mark: Mark| match comparison.focus {
        Focus::Normal => Symbol::Line(line),
        Focus::Distance | Focus::Position | Focus::Uv | Focus::Origin | Focus::Shape => {
            Symbol::Mark(mark)
        }
    };
    match (comparison.wanted, comparison.focus) {
        (None, _) => sheet.add_wanted(Symbol::None, "no hit"),
        // The origin is that of the ray, which has its own entry.
        (Some(hit), Focus::Origin) => sheet.add_wanted(Symbol::Mark(Mark::Right), &hit.text()),
        (Some(hit), focus) => {
            sheet.add_wanted(symbol(LineStyle::Right, Mark::Right), &field(&hit, focus));
        }
    }
    match (comparison.got, comparison.focus) {
        (HitAnswer::NoAnswer, _) => {}
        (HitAnswer::Miss, _) => sheet.add_got(Symbol::None, "no hit"),
        // Nothing in the picture shows the number.
        (HitAnswer::Hit(hit), Focus::Shape) => {
            sheet.add_got(Symbol::None, &field(&hit, Focus::Shape));
        }
        (HitAnswer::Hit(hit), focus) => {
            let is_drawn = matches!(focus, Focus::Distance | Focus::Position);
            let off = if is_off && is_drawn {
                ", outside the picture"
            } else {
                ""
            };
            let text = format!("{}{off}", field(&hit, focus));
            sheet.add_got(symbol(LineStyle::Wrong, Mark::Wrong), &text);
        }
    }
    add_range_legend(sheet, comparison);
    let text = match window.distance_outside(DVec2::ZERO) {
        away if away > 0.0 => format!("the ray starts {} outside the picture", short(away)),
        _ => "the ray's origin".to_owned(),
    };
    sheet.add_legend(Symbol::Mark(Mark::Origin), &text);
}

/// Returns the text for a field of a hit.
fn field(hit: &DrawnHit, field: Focus) -> String {
    match field {
        Focus::Distance => hit.text(),
        Focus::Position => describe::point(hit.position.as_vec3()),
        Focus::Normal => format!("normal {}", point(hit.normal)),
        Focus::Uv => format!("uv {}", describe::uv(hit.uv.as_vec2())),
        Focus::Origin => format!("origin {}", describe::point(hit.origin.as_vec3())),
        Focus::Shape => format!("shape {}", hit.shape.unwrap_or_default()),
    }
}

/// Adds the ray's range to the legend if it is limited.
pub(super) fn add_range_legend(sheet: &mut Sheet, comparison: &HitComparison) {
    if let Some(range) = comparison.limited_range() {
        let text = format!("the ray's range: {}", describe::interval(range));
        sheet.add_legend(Symbol::Line(LineStyle::Range), &text);
    }
}
