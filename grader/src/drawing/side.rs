//! Draws a ray from the side. The ray points to the right, and distances along it are to scale.

use glam::{DVec2, DVec3, dvec2};
use judging::describe;
use protocol::Trace;

use super::canvas::{Canvas, Mark};
use super::hit_comparison::{Focus, HitComparison, hit_text};
use super::ink::LineStyle;
use super::numbers::{point, short};
use super::sheet::{Sheet, Symbol};
use super::window::{Window, extent};

/// A side view of a ray: a plane that contains the ray, oriented so that the ray points to the
/// right.
#[derive(Clone, Copy, Debug)]
pub(super) struct SideView<'a> {
    comparison: &'a HitComparison,
    origin: DVec3,
    dir: DVec3,
    up: DVec3,
}

impl SideView<'_> {
    /// Creates the plane through the ray that contains the direction `toward`. If `toward` is
    /// parallel to the ray, any plane through the ray will do.
    pub(super) fn new(comparison: &HitComparison, toward: DVec3) -> SideView<'_> {
        let dir = comparison.dir();
        let up = (toward - toward.dot(dir) * dir).try_normalize();
        SideView {
            comparison,
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

    /// Returns the points of the expected and the submitted hit, projected onto the plane.
    fn hits(&self) -> [Option<DVec2>; 2] {
        let wanted = self.comparison.wanted.map(|hit| hit.position.as_dvec3());
        [wanted, self.comparison.got_point()].map(|point| Some(self.project(point?)))
    }

    /// Returns the points that the drawing should show: the points of `shape`, the ray's origin,
    /// the hits, and the ends of the ray's range. Points so far away that the shape would shrink to
    /// a dot are left out.
    pub(super) fn landmarks(&self, shape: &[DVec2]) -> Vec<DVec2> {
        /// The maximum distance from the shape, as a multiple of its size.
        const MAX_SIZES: f64 = 5.0;

        let mut seen = shape.to_vec();
        let Some((min, max)) = extent(shape.iter().copied()) else {
            return seen;
        };
        let reach = MAX_SIZES * (max - min).length().max(1e-9);
        let range = self.comparison.ray.range;
        let ends = [range.min, range.max].map(|end| self.project(self.comparison.at(end.into())));
        let hits = self.hits().into_iter().flatten();
        let others = hits.chain([DVec2::ZERO]).chain(ends);
        seen.extend(others.filter(|at| at.distance(at.clamp(min, max)) <= reach));
        seen
    }

    /// Draws the ray's line, its origin and, if its range is limited, the range.
    pub(super) fn draw_ray(&self, canvas: &mut Canvas, window: &Window) {
        let range = self.comparison.limited_range();
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

    /// Draws the expected and the submitted hit, including the field in focus.
    pub(super) fn draw_hits(&self, canvas: &mut Canvas, window: &Window) {
        /// The length of the arrow for a unit normal, in page units.
        const ARROW: f64 = 46.0;

        let comparison = self.comparison;
        let [wanted, got] = self.hits();
        if let (Focus::Normal, Some(foot), Some(right), Some(hit)) = (
            comparison.focus,
            wanted,
            comparison.wanted,
            comparison.got_hit(),
        ) {
            let mut arrow = |normal: DVec3, aside: f64, line: LineStyle| {
                let length = normal.length().clamp(0.4, 1.6) / normal.length();
                let seen = self.project_vector(normal);
                let foot = foot + window.world_length(aside) * seen.perp().normalize_or_zero();
                let tip = foot + window.world_length(ARROW) * length * seen;
                canvas.arrow(window, [foot, tip], line);
            };
            let [right, wrong] = [right, hit].map(|hit| hit.normal.as_dvec3());
            // Arrows that would cover each other are drawn side by side.
            let is_same_way = right.angle_between(wrong) < 0.15;
            let aside = if is_same_way { 6.0 } else { 0.0 };
            arrow(right, 0.0, LineStyle::Right);
            arrow(wrong, aside, LineStyle::Wrong);
            canvas.mark(window.page_position(foot), Mark::Right);
            return;
        }
        canvas.mark_pinned(window, wanted, Mark::Right);
        let marked = match (comparison.focus, comparison.got_hit()) {
            (Focus::Distance | Focus::Position, _) => got,
            (Focus::Origin, Some(hit)) => Some(self.project(hit.origin.as_dvec3())),
            (Focus::Normal | Focus::Uv | Focus::Origin | Focus::Shape, _) => None,
        };
        canvas.mark_pinned(window, marked, Mark::Wrong);
    }

    /// Adds the legend for the ray and both hits.
    pub(super) fn draw_legend(&self, sheet: &mut Sheet, window: &Window) {
        let comparison = self.comparison;
        let focus = comparison.focus;
        let [_, got] = self.hits();
        let got = got.and_then(|got| window.pin_to_border(got));
        let is_drawn = matches!(focus, Focus::Distance | Focus::Position);
        let is_off = is_drawn && got.is_some_and(|(_, is_off)| is_off);
        let symbol = |line: LineStyle, mark: Mark| {
            if focus == Focus::Normal {
                Symbol::Line(line)
            } else {
                Symbol::Mark(mark)
            }
        };
        let right = symbol(LineStyle::Right, Mark::Right);
        match comparison.wanted {
            None => sheet.add_wanted(Symbol::None, "no hit"),
            // The expected origin is the ray's origin, which has its own legend entry.
            Some(hit) if focus == Focus::Origin => sheet.add_wanted(right, &hit_text(&hit)),
            Some(hit) => sheet.add_wanted(right, &field(&hit, focus)),
        }
        match comparison.got {
            None => {}
            Some(None) => sheet.add_got(Symbol::None, "no hit"),
            // Nothing in the picture shows the shape's number.
            Some(Some(hit)) if focus == Focus::Shape => {
                sheet.add_got(Symbol::None, &field(&hit, focus));
            }
            Some(Some(hit)) => {
                let off = if is_off { ", outside the picture" } else { "" };
                let text = field(&hit, focus) + off;
                sheet.add_got(symbol(LineStyle::Wrong, Mark::Wrong), &text);
            }
        }
        add_range_legend(sheet, comparison);
        let text = match window.distance_outside(DVec2::ZERO) {
            away if away > 0.0 => {
                format!("the ray starts {} units outside the picture", short(away))
            }
            _ => "the ray's origin".to_owned(),
        };
        sheet.add_legend(Symbol::Mark(Mark::Origin), &text);
    }
}

/// Returns the text for a field of a hit.
fn field(hit: &Trace, field: Focus) -> String {
    match field {
        Focus::Distance => hit_text(hit),
        Focus::Position => describe::point(hit.position),
        Focus::Normal => format!("normal {}", point(hit.normal.as_dvec3())),
        Focus::Uv => format!("uv {}", describe::uv(hit.uv)),
        Focus::Origin => format!("origin {}", describe::point(hit.origin)),
        Focus::Shape => format!("shape {}", hit.shape),
    }
}

/// Adds the ray's range to the legend if it is limited.
pub(super) fn add_range_legend(sheet: &mut Sheet, comparison: &HitComparison) {
    if let Some(range) = comparison.limited_range() {
        let text = format!("the ray's range: {}", describe::interval(range));
        sheet.add_legend(Symbol::Line(LineStyle::Range), &text);
    }
}
