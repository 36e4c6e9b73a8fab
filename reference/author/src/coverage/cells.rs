//! The cells of the table: what distinguishes one question from another that asks the same.

use std::collections::BTreeMap;

use glam::DVec3;
use judging::exam::ExamQuestion;
use protocol::{Geometry, Question, Ray, Shape};

use crate::oracle::bbox::Bounds;
use crate::oracle::scan;

/// The name of a cell, such as `scale: room`.
pub(super) type Cell = &'static str;

/// How often each cell is asked.
pub(super) type Counts = BTreeMap<Cell, usize>;

const SCALES: [Cell; 4] = ["scale: dust", "scale: small", "scale: one", "scale: room"];
const PLACES: [Cell; 2] = ["place: origin", "place: far"];
const OCTANTS: Cell = "direction: each octant";
const OCTANT: [Cell; 8] = ["+++", "-++", "+-+", "--+", "++-", "-+-", "+--", "---"];
const QUADRANTS: Cell = "pixel: each quadrant";
const QUADRANT: [Cell; 4] = ["lower left", "lower right", "upper left", "upper right"];
const HISTORY: [Cell; 3] = [
    "history: first call",
    "history: tenth call",
    "history: thousandth call",
];
const IN_FRONT: Cell = "start: in front";
const BEHIND: Cell = "start: behind";
const OUTSIDE: Cell = "start: outside";
const INSIDE: Cell = "start: inside";
const ON_SURFACE: Cell = "start: on the surface";
const SIZES: [Cell; 4] = ["size: none", "size: one", "size: few", "size: many"];

/// Returns the cells that are distinguished in a task whose first question is this one, in the order
/// of the table.
pub(super) fn of_task(first: &Question) -> Vec<Cell> {
    let of_rays = |start: &[Cell], more: &[Cell]| {
        [&SCALES[..], &PLACES, &[OCTANTS], start, more, &HISTORY].concat()
    };
    match first {
        Question::SampleRay(_) => {
            let films = ["film: wide", "film: high", "film: large", QUADRANTS];
            [&films[..], &HISTORY].concat()
        }
        Question::Hit(table) => match &table.subject {
            Geometry::List { shapes } => match shapes.first() {
                Some(Shape::Sphere { .. }) => of_rays(&[OUTSIDE, INSIDE, ON_SURFACE], &[]),
                _ => of_rays(&[IN_FRONT, BEHIND, ON_SURFACE], &[]),
            },
            Geometry::Tree { .. } | Geometry::BuiltTree { .. } => {
                of_rays(&[OUTSIDE, INSIDE], &SIZES)
            }
        },
        Question::BBoxHit(_) => of_rays(&[OUTSIDE, INSIDE], &[]),
        Question::Build { .. } => [&SCALES[..], &PLACES, &SIZES].concat(),
        Question::Reflect(_) | Question::Radiance { .. } => HISTORY.into(),
    }
}

/// Adds the cells of all elements of a question.
pub(super) fn count(asked: &ExamQuestion, counts: &mut Counts) {
    let mut add = |cell: Cell, times: usize| *counts.entry(cell).or_default() += times;
    let calls = asked.question.count();
    match &asked.question {
        Question::SampleRay(table) => {
            let film = table.subject.film;
            let is_large = film.max_element() >= 1000;
            add("film: wide", calls * usize::from(film.x > film.y));
            add("film: high", calls * usize::from(film.y > film.x));
            add("film: large", calls * usize::from(is_large));
            for sample in table.rows.to_vec().iter() {
                let (right, up) = (2 * sample.pixel.x >= film.x, 2 * sample.pixel.y >= film.y);
                add(QUADRANT[usize::from(right) + 2 * usize::from(up)], 1);
            }
        }
        Question::Hit(table) => {
            let shapes = table.subject.shapes();
            let bounds = bounds(shapes);
            place(&bounds, calls, &mut add);
            let is_list = matches!(table.subject, Geometry::List { .. });
            if !is_list {
                add(size(shapes.len()), calls);
            }
            for ray in table.rows.to_vec().iter() {
                let start = if is_list {
                    start_at_shapes(shapes, ray)
                } else {
                    start_at_box(&bounds, ray)
                };
                add(start, 1);
                add(octant(ray), 1);
            }
        }
        Question::BBoxHit(table) => {
            let bounds = Bounds::new(table.subject.min, table.subject.max);
            place(&bounds, calls, &mut add);
            for query in table.rows.to_vec().iter() {
                add(start_at_box(&bounds, &query.ray), 1);
                add(octant(&query.ray), 1);
            }
        }
        Question::Build { shapes, .. } => {
            place(&bounds(shapes), 1, &mut add);
            add(size(shapes.len()), 1);
        }
        Question::Reflect(_) | Question::Radiance { .. } => {}
    }
    add(HISTORY[0], 1);
    add(HISTORY[1], calls.saturating_sub(9));
    add(HISTORY[2], calls.saturating_sub(999));
}

fn bounds(shapes: &[Shape]) -> Bounds {
    let all = shapes.iter().map(scan::bounds);
    let all = all.reduce(|all, next| all.union(&next));
    all.unwrap_or(Bounds::around([DVec3::ZERO]))
}

/// Adds the scale and the place of what is in this box.
fn place(bounds: &Bounds, calls: usize, add: &mut impl FnMut(Cell, usize)) {
    let size = bounds.diagonal();
    let scale = match size {
        ..1e-4 => 0,
        ..0.1 => 1,
        ..30.0 => 2,
        _ => 3,
    };
    add(SCALES[scale], calls);
    let distance = bounds.center().abs().max_element();
    let is_far = distance > size && distance > 10.0;
    add(PLACES[usize::from(is_far)], calls);
}

fn size(count: usize) -> Cell {
    match count {
        0 => SIZES[0],
        1 => SIZES[1],
        2..=16 => SIZES[2],
        _ => SIZES[3],
    }
}

/// Returns where a ray starts: where its range begins, seen from the first shape.
fn start_at_shapes(shapes: &[Shape], ray: &Ray) -> Cell {
    let start = ray.origin.as_dvec3();
    match shapes.first() {
        Some(Shape::Sphere { center, radius, .. }) => {
            match start.distance(center.as_dvec3()) / f64::from(*radius) {
                ..0.99 => INSIDE,
                ..1.01 => ON_SURFACE,
                _ => OUTSIDE,
            }
        }
        shape => {
            let corners = shape.and_then(scan::corners);
            corners.map_or(OUTSIDE, |corners| side(corners, start))
        }
    }
}

fn octant(ray: &Ray) -> Cell {
    OCTANT[ray.dir.is_negative_bitmask() as usize]
}

/// Returns the side of a triangle's plane on which a point is.
fn side([p0, p1, p2]: [DVec3; 3], point: DVec3) -> Cell {
    let normal = (p1 - p0).cross(p2 - p0).normalize_or_zero();
    let height = (point - p0).dot(normal) / (p1 - p0).length().max(f64::MIN_POSITIVE);
    match height {
        0.01.. => IN_FRONT,
        ..-0.01 => BEHIND,
        _ => ON_SURFACE,
    }
}

fn start_at_box(bounds: &Bounds, ray: &Ray) -> Cell {
    let start = Bounds::around([ray.origin.as_dvec3()]);
    let is_inside = bounds.contains(&start);
    if is_inside { INSIDE } else { OUTSIDE }
}

/// Returns how often a cell is asked. A cell that stands for several is asked as often as the one of
/// them that is asked least.
pub(super) fn times(counts: &Counts, cell: Cell) -> usize {
    let count = |cell: &Cell| counts.get(cell).copied().unwrap_or(0);
    match cell {
        OCTANTS => OCTANT.iter().map(count).min().unwrap_or(0),
        QUADRANTS => QUADRANT.iter().map(count).min().unwrap_or(0),
        cell => count(&cell),
    }
}
