//! A ray from the side: it goes to the right, and distances along it are true to scale.

use glam::{DVec2, DVec3, dvec2};

use super::canvas::{Canvas, Mark};
use super::encounter::{Encounter, Focus, Got};
use super::ink::{Ink, Line};
use super::sheet::{Sheet, Sign};
use super::window::{Window, extent};
use super::words::{point, short};
use crate::describe;

/// A plane through a ray, of which one direction across the ray goes up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    origin: DVec3,
    dir: DVec3,
    up: DVec3,
}

impl Side {
    /// The plane through the ray in which `toward` lies, or any if that is along the ray.
    pub(super) fn of(encounter: &Encounter, toward: DVec3) -> Side {
        let dir = encounter.dir();
        let up = (toward - toward.dot(dir) * dir).try_normalize();
        Side {
            origin: encounter.ray.origin.as_dvec3(),
            dir,
            up: up.unwrap_or_else(|| dir.any_orthonormal_vector()),
        }
    }

    /// A point as it is seen from the side.
    pub(super) fn see(&self, point: DVec3) -> DVec2 {
        self.turn(point - self.origin)
    }

    /// A direction as it is seen from the side.
    pub(super) fn turn(&self, vector: DVec3) -> DVec2 {
        dvec2(vector.dot(self.dir), vector.dot(self.up))
    }

    /// A point as it is seen along the ray, which is at (0, 0).
    pub(super) fn see_along(&self, point: DVec3) -> DVec2 {
        let aside = point - self.origin;
        dvec2(aside.dot(self.dir.cross(self.up)), aside.dot(self.up))
    }
}

/// The points to be seen beside those of the shape: of the ray's origin, the hits and the ends of
/// the range those that are not so far away that the shape would become a dot.
pub(super) fn landmarks(encounter: &Encounter, side: &Side, shape: &[DVec2]) -> Vec<DVec2> {
    /// So many times the shape's size.
    const FARTHEST: f64 = 5.0;

    let mut seen = shape.to_vec();
    let Some((min, max)) = extent(shape.iter().copied()) else {
        return seen;
    };
    let reach = FARTHEST * (max - min).length().max(1e-9);
    let range = encounter.ray.range;
    let ends = [range.min, range.max].map(|end| side.see(encounter.at(end.into())));
    let hits = [
        encounter.wanted.map(|met| side.see(met.position)),
        encounter.got_point().map(|point| side.see(point)),
    ];
    let others = hits.into_iter().flatten().chain([DVec2::ZERO]).chain(ends);
    seen.extend(others.filter(|at| at.distance(at.clamp(min, max)) <= reach));
    seen
}

/// The line of the ray, its start, and the part that counts where that is not all ahead.
pub(super) fn ray(canvas: &mut Canvas, window: &Window, encounter: &Encounter) {
    const FAR: f64 = 1e7;

    let mut along = |from: f64, to: f64, line: Line| {
        if let Some((from, to)) = window.clipped(dvec2(from, 0.0), dvec2(to, 0.0)) {
            canvas.line(from, to, line);
        }
    };
    let range = encounter.range();
    if let Some(range) = range {
        let (min, max) = (f64::from(range.min), f64::from(range.max));
        along(min.max(-FAR), max.min(FAR), Line::Range);
    }
    along(-FAR, 0.0, Line::Behind);
    along(0.0, FAR, Line::Ray);
    // The ends of the range, across the ray.
    let ends = range.map_or([f32::NAN; 2], |range| [range.min, range.max]);
    for end in ends {
        if let Some((at, false)) = window.pinned(dvec2(end.into(), 0.0)) {
            let half = dvec2(0.0, 9.0);
            canvas.line(at - half, at + half, Line::Outline);
        }
    }
    if let Some((start, false)) = window.pinned(DVec2::ZERO) {
        canvas.mark(start, Mark::Origin);
    }
}

/// The hits that are wanted and that came, and what the drawing is about.
pub(super) fn hits(canvas: &mut Canvas, window: &Window, encounter: &Encounter, side: &Side) {
    /// The length of a normal on the page.
    const ARROW: f64 = 46.0;

    let wanted = encounter.wanted.map(|met| side.see(met.position));
    let got = encounter.got_point().map(|point| side.see(point));
    if let (Focus::Normal, Some(wanted), Got::Hit(met)) =
        (encounter.focus, encounter.wanted, encounter.got)
    {
        let foot = side.see(wanted.position);
        let mut arrow = |normal: DVec3, aside: f64, line: Line, ink: Ink| {
            let length = normal.length().clamp(0.4, 1.6) / normal.length();
            let seen = side.turn(normal);
            let foot = foot + window.world_length(aside) * seen.perp().normalize_or_zero();
            let tip = foot + window.world_length(ARROW) * length * seen;
            if let Some((foot, tip)) = window.clipped(foot, tip) {
                canvas.arrow(foot, tip, line, ink);
            }
        };
        // Beside each other, where they would lie on each other.
        let is_same_way = wanted.normal.angle_between(met.normal) < 0.15;
        let aside = if is_same_way { 6.0 } else { 0.0 };
        arrow(wanted.normal, 0.0, Line::Right, Ink::Right);
        arrow(met.normal, aside, Line::Wrong, Ink::Wrong);
        canvas.mark(window.page(foot), Mark::Right);
        return;
    }
    if let Some((at, _)) = wanted.and_then(|at| window.pinned(at)) {
        canvas.mark(at, Mark::Right);
    }
    let is_marked = match encounter.focus {
        Focus::Distance | Focus::Position => true,
        Focus::Normal | Focus::Uv | Focus::Origin | Focus::Material => false,
    };
    if let Some((at, _)) = got.filter(|_| is_marked).and_then(|at| window.pinned(at)) {
        canvas.mark(at, Mark::Wrong);
    }
    if let (Focus::Origin, Got::Hit(met)) = (encounter.focus, encounter.got)
        && let Some((at, _)) = window.pinned(side.see(met.origin))
    {
        canvas.mark(at, Mark::Wrong);
    }
}

/// What the signs of both mean, given the window that they are seen through.
pub(super) fn explain(sheet: &mut Sheet, encounter: &Encounter, side: &Side, window: &Window) {
    let got = encounter
        .got_point()
        .and_then(|point| window.pinned(side.see(point)));
    let is_off = got.is_some_and(|(_, is_off)| is_off);
    let off = if is_off { ", off the picture" } else { "" };
    let distance = |distance: f64| describe::number(distance as f32);
    match (encounter.wanted, encounter.focus) {
        (Some(met), Focus::Normal) => {
            let words = format!("wanted: normal {}", point(met.normal));
            sheet.explain(Sign::Line(Line::Right), &words);
        }
        (Some(met), Focus::Position) => {
            let words = format!("wanted: {}", describe::point(met.position.as_vec3()));
            sheet.explain(Sign::Mark(Mark::Right), &words);
        }
        (Some(met), Focus::Uv) => {
            let words = format!("wanted: uv {}", describe::uv(met.uv.as_vec2()));
            sheet.explain(Sign::Mark(Mark::Right), &words);
        }
        (Some(met), Focus::Material) => {
            let words = format!("wanted: material {}", met.material.unwrap_or_default());
            sheet.explain(Sign::Mark(Mark::Right), &words);
        }
        (Some(met), Focus::Distance | Focus::Origin) => {
            let words = format!("wanted: a hit at {}", distance(met.distance));
            sheet.explain(Sign::Mark(Mark::Right), &words);
        }
        (None, _) => sheet.explain(Sign::None, "wanted: no hit"),
    }
    match (encounter.got, encounter.focus) {
        (Got::NoAnswer, _) => {}
        (Got::Miss, _) => sheet.explain(Sign::None, "got: no hit"),
        (Got::Hit(met), Focus::Normal) => {
            let words = format!("got: normal {}", point(met.normal));
            sheet.explain(Sign::Line(Line::Wrong), &words);
        }
        (Got::Hit(met), Focus::Position) => {
            let words = format!("got: {}{off}", describe::point(met.position.as_vec3()));
            sheet.explain(Sign::Mark(Mark::Wrong), &words);
        }
        (Got::Hit(met), Focus::Uv) => {
            let words = format!("got: uv {}", describe::uv(met.uv.as_vec2()));
            sheet.explain(Sign::Mark(Mark::Wrong), &words);
        }
        (Got::Hit(met), Focus::Origin) => {
            let words = format!("got: origin {}", describe::point(met.origin.as_vec3()));
            sheet.explain(Sign::Mark(Mark::Wrong), &words);
        }
        (Got::Hit(met), Focus::Distance) => {
            let words = format!("got: a hit at {}{off}", distance(met.distance));
            sheet.explain(Sign::Mark(Mark::Wrong), &words);
        }
        (Got::Hit(met), Focus::Material) => {
            let words = format!("got: material {}", met.material.unwrap_or_default());
            sheet.explain(Sign::None, &words);
        }
    }
    if let Some(range) = encounter.range() {
        let words = format!("the range that counts: {}", describe::interval(range));
        sheet.explain(Sign::Line(Line::Range), &words);
    }
    let words = match window.beyond_border(DVec2::ZERO) {
        away if away > 0.0 => format!("the ray starts {} off the picture", short(away)),
        _ => "where the ray starts".to_owned(),
    };
    sheet.explain(Sign::Mark(Mark::Origin), &words);
}
