//! A ray from the side: it goes to the right, and distances along it are true to scale.

use glam::{DVec2, DVec3, dvec2};

use super::canvas::{Canvas, Mark};
use super::hit_comparison::{Focus, HitAnswer, HitComparison};
use super::ink::{Ink, LineStyle};
use super::numbers::{point, short};
use super::sheet::{Sheet, Symbol};
use super::window::{Window, extent};
use crate::describe;

/// A plane through a ray, of which one direction across the ray goes up.
#[derive(Clone, Copy, Debug)]
pub(super) struct SideView {
    origin: DVec3,
    dir: DVec3,
    up: DVec3,
}

impl SideView {
    /// The plane through the ray in which `toward` lies, or any if that is along the ray.
    pub(super) fn new(encounter: &HitComparison, toward: DVec3) -> SideView {
        let dir = encounter.dir();
        let up = (toward - toward.dot(dir) * dir).try_normalize();
        SideView {
            origin: encounter.ray.origin.as_dvec3(),
            dir,
            up: up.unwrap_or_else(|| dir.any_orthonormal_vector()),
        }
    }

    /// A point as it is seen from the side.
    pub(super) fn project(&self, point: DVec3) -> DVec2 {
        self.project_vector(point - self.origin)
    }

    /// A direction as it is seen from the side.
    pub(super) fn project_vector(&self, vector: DVec3) -> DVec2 {
        dvec2(vector.dot(self.dir), vector.dot(self.up))
    }

    /// A point as it is seen along the ray, which is at (0, 0).
    pub(super) fn project_along_ray(&self, point: DVec3) -> DVec2 {
        let aside = point - self.origin;
        dvec2(aside.dot(self.dir.cross(self.up)), aside.dot(self.up))
    }
}

/// The points to be seen beside those of the shape: of the ray's origin, the hits and the ends of
/// the range those that are not so far away that the shape would become a dot.
pub(super) fn landmarks(encounter: &HitComparison, side: &SideView, shape: &[DVec2]) -> Vec<DVec2> {
    /// So many times the shape's size.
    const MAX_SIZES: f64 = 5.0;

    let mut seen = shape.to_vec();
    let Some((min, max)) = extent(shape.iter().copied()) else {
        return seen;
    };
    let reach = MAX_SIZES * (max - min).length().max(1e-9);
    let range = encounter.ray.range;
    let ends = [range.min, range.max].map(|end| side.project(encounter.at(end.into())));
    let hits = [
        encounter.wanted.map(|met| side.project(met.position)),
        encounter.got_point().map(|point| side.project(point)),
    ];
    let others = hits.into_iter().flatten().chain([DVec2::ZERO]).chain(ends);
    seen.extend(others.filter(|at| at.distance(at.clamp(min, max)) <= reach));
    seen
}

/// The line of the ray, its start, and the part that counts where that is not all ahead.
pub(super) fn draw_ray(canvas: &mut Canvas, window: &Window, encounter: &HitComparison) {
    const FAR: f64 = 1e7;

    let mut along = |from: f64, to: f64, line: LineStyle| {
        if let Some((from, to)) = window.clip_segment(dvec2(from, 0.0), dvec2(to, 0.0)) {
            canvas.line(from, to, line);
        }
    };
    let range = encounter.limited_range();
    if let Some(range) = range {
        let (min, max) = (f64::from(range.min), f64::from(range.max));
        along(min.max(-FAR), max.min(FAR), LineStyle::Range);
    }
    along(-FAR, 0.0, LineStyle::Behind);
    along(0.0, FAR, LineStyle::Ray);
    // The ends of the range, across the ray.
    let ends = range.map_or([f32::NAN; 2], |range| [range.min, range.max]);
    for end in ends {
        if let Some((at, false)) = window.pin_to_border(dvec2(end.into(), 0.0)) {
            let half = dvec2(0.0, 9.0);
            canvas.line(at - half, at + half, LineStyle::Outline);
        }
    }
    if let Some((start, false)) = window.pin_to_border(DVec2::ZERO) {
        canvas.mark(start, Mark::Origin);
    }
}

/// The hits that are wanted and that came, and what the drawing is about.
pub(super) fn draw_hits(
    canvas: &mut Canvas,
    window: &Window,
    encounter: &HitComparison,
    side: &SideView,
) {
    /// The length of a normal on the page.
    const ARROW: f64 = 46.0;

    let wanted = encounter.wanted.map(|met| side.project(met.position));
    let got = encounter.got_point().map(|point| side.project(point));
    if let (Focus::Normal, Some(wanted), HitAnswer::Hit(met)) =
        (encounter.focus, encounter.wanted, encounter.got)
    {
        let foot = side.project(wanted.position);
        let mut arrow = |normal: DVec3, aside: f64, line: LineStyle, ink: Ink| {
            let length = normal.length().clamp(0.4, 1.6) / normal.length();
            let seen = side.project_vector(normal);
            let foot = foot + window.to_world_length(aside) * seen.perp().normalize_or_zero();
            let tip = foot + window.to_world_length(ARROW) * length * seen;
            if let Some((foot, tip)) = window.clip_segment(foot, tip) {
                canvas.arrow(foot, tip, line, ink);
            }
        };
        // Beside each other, where they would lie on each other.
        let is_same_way = wanted.normal.angle_between(met.normal) < 0.15;
        let aside = if is_same_way { 6.0 } else { 0.0 };
        arrow(wanted.normal, 0.0, LineStyle::Right, Ink::Right);
        arrow(met.normal, aside, LineStyle::Wrong, Ink::Wrong);
        canvas.mark(window.to_page(foot), Mark::Right);
        return;
    }
    if let Some((at, _)) = wanted.and_then(|at| window.pin_to_border(at)) {
        canvas.mark(at, Mark::Right);
    }
    let is_marked = match encounter.focus {
        Focus::Distance | Focus::Position => true,
        Focus::Normal | Focus::Uv | Focus::Origin | Focus::Material => false,
    };
    if let Some((at, _)) = got
        .filter(|_| is_marked)
        .and_then(|at| window.pin_to_border(at))
    {
        canvas.mark(at, Mark::Wrong);
    }
    if let (Focus::Origin, HitAnswer::Hit(met)) = (encounter.focus, encounter.got)
        && let Some((at, _)) = window.pin_to_border(side.project(met.origin))
    {
        canvas.mark(at, Mark::Wrong);
    }
}

/// What the signs of both mean, given the window that they are seen through.
pub(super) fn draw_legend(
    sheet: &mut Sheet,
    encounter: &HitComparison,
    side: &SideView,
    window: &Window,
) {
    let got = encounter
        .got_point()
        .and_then(|point| window.pin_to_border(side.project(point)));
    let is_off = got.is_some_and(|(_, is_off)| is_off);
    let off = if is_off { ", off the picture" } else { "" };
    let distance = |distance: f64| describe::number(distance as f32);
    match (encounter.wanted, encounter.focus) {
        (Some(met), Focus::Normal) => {
            let words = format!("wanted: normal {}", point(met.normal));
            sheet.add_legend(Symbol::Line(LineStyle::Right), &words);
        }
        (Some(met), Focus::Position) => {
            let words = format!("wanted: {}", describe::point(met.position.as_vec3()));
            sheet.add_legend(Symbol::Mark(Mark::Right), &words);
        }
        (Some(met), Focus::Uv) => {
            let words = format!("wanted: uv {}", describe::uv(met.uv.as_vec2()));
            sheet.add_legend(Symbol::Mark(Mark::Right), &words);
        }
        (Some(met), Focus::Material) => {
            let words = format!("wanted: material {}", met.material.unwrap_or_default());
            sheet.add_legend(Symbol::Mark(Mark::Right), &words);
        }
        (Some(met), Focus::Distance | Focus::Origin) => {
            let words = format!("wanted: a hit at {}", distance(met.distance));
            sheet.add_legend(Symbol::Mark(Mark::Right), &words);
        }
        (None, _) => sheet.add_legend(Symbol::None, "wanted: no hit"),
    }
    match (encounter.got, encounter.focus) {
        (HitAnswer::NoAnswer, _) => {}
        (HitAnswer::Miss, _) => sheet.add_legend(Symbol::None, "got: no hit"),
        (HitAnswer::Hit(met), Focus::Normal) => {
            let words = format!("got: normal {}", point(met.normal));
            sheet.add_legend(Symbol::Line(LineStyle::Wrong), &words);
        }
        (HitAnswer::Hit(met), Focus::Position) => {
            let words = format!("got: {}{off}", describe::point(met.position.as_vec3()));
            sheet.add_legend(Symbol::Mark(Mark::Wrong), &words);
        }
        (HitAnswer::Hit(met), Focus::Uv) => {
            let words = format!("got: uv {}", describe::uv(met.uv.as_vec2()));
            sheet.add_legend(Symbol::Mark(Mark::Wrong), &words);
        }
        (HitAnswer::Hit(met), Focus::Origin) => {
            let words = format!("got: origin {}", describe::point(met.origin.as_vec3()));
            sheet.add_legend(Symbol::Mark(Mark::Wrong), &words);
        }
        (HitAnswer::Hit(met), Focus::Distance) => {
            let words = format!("got: a hit at {}{off}", distance(met.distance));
            sheet.add_legend(Symbol::Mark(Mark::Wrong), &words);
        }
        (HitAnswer::Hit(met), Focus::Material) => {
            let words = format!("got: material {}", met.material.unwrap_or_default());
            sheet.add_legend(Symbol::None, &words);
        }
    }
    if let Some(range) = encounter.limited_range() {
        let words = format!("the range that counts: {}", describe::interval(range));
        sheet.add_legend(Symbol::Line(LineStyle::Range), &words);
    }
    let words = match window.distance_outside(DVec2::ZERO) {
        away if away > 0.0 => format!("the ray starts {} off the picture", short(away)),
        _ => "where the ray starts".to_owned(),
    };
    sheet.add_legend(Symbol::Mark(Mark::Origin), &words);
}
