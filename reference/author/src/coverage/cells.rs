//! The cells of the table: what distinguishes one question from another that asks the same.

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::{DVec3, UVec2};
use judging::exam::ExamQuestion;
use judging::scene::{self, QuestionScene};
use protocol::{AnyTable, Question, Ray, Record, Shape, Value};

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
    if let Question::Build { .. } = first {
        return [&SCALES[..], &PLACES, &SIZES].concat();
    }
    let Some(subject) = first.table().map(AnyTable::subject) else {
        return HISTORY.into();
    };
    if film(subject).is_some() {
        let films = ["film: wide", "film: high", "film: large", QUADRANTS];
        return [&films[..], &HISTORY].concat();
    }
    let (start, more): (&[Cell], &[Cell]) = match Target::of(first) {
        None => return HISTORY.into(),
        Some(Target::Tree(_)) => (&[OUTSIDE, INSIDE], &SIZES),
        Some(Target::Box(_)) => (&[OUTSIDE, INSIDE], &[]),
        Some(Target::Shapes(shapes)) => match shapes.first() {
            Some(Shape::Sphere { .. }) => (&[OUTSIDE, INSIDE, ON_SURFACE], &[]),
            _ => (&[IN_FRONT, BEHIND, ON_SURFACE], &[]),
        },
    };
    [&SCALES[..], &PLACES, &[OCTANTS], start, more, &HISTORY].concat()
}

/// Adds the cells of all elements of a question.
pub(super) fn count(asked: &ExamQuestion, counts: &mut Counts) {
    let mut add = |cell: Cell, times: usize| *counts.entry(cell).or_default() += times;
    let question = &asked.question;
    let calls = question.count();
    let subject = question.table().map(AnyTable::subject);
    if let Question::Build { shapes, .. } = question {
        place(&bounds(shapes), 1, &mut add);
        add(size(shapes.len()), 1);
    } else if let Some(film) = subject.and_then(film) {
        let is_large = film.max_element() >= 1000;
        add("film: wide", calls * usize::from(film.x > film.y));
        add("film: high", calls * usize::from(film.y > film.x));
        add("film: large", calls * usize::from(is_large));
        for pixel in (0..calls).filter_map(|row| pixel(question, row)) {
            let (right, up) = (2 * pixel.x >= film.x, 2 * pixel.y >= film.y);
            add(QUADRANT[usize::from(right) + 2 * usize::from(up)], 1);
        }
    } else if let Some(target) = Target::of(question) {
        let bounds = target.bounds();
        place(&bounds, calls, &mut add);
        if let Target::Tree(shapes) = &target {
            add(size(shapes.len()), calls);
        }
        for ray in (0..calls).filter_map(|row| scene::ray(question, row)) {
            let start = match &target {
                Target::Shapes(shapes) => start_at_shapes(shapes, &ray),
                Target::Tree(_) | Target::Box(_) => start_at_box(&bounds, &ray),
            };
            add(start, 1);
            add(octant(&ray), 1);
        }
    }
    add(HISTORY[0], 1);
    add(HISTORY[1], calls.saturating_sub(9));
    add(HISTORY[2], calls.saturating_sub(999));
}

/// The thing that the rays of a table are tested with.
enum Target<'a> {
    /// Shapes, one after the other.
    Shapes(Cow<'a, [Shape]>),
    /// A tree over shapes.
    Tree(Cow<'a, [Shape]>),
    /// The box around anything else in space.
    Box(Bounds),
}

impl<'a> Target<'a> {
    /// Returns the target of a question's rays, or `None` if its subject is nowhere in space.
    fn of(question: &'a Question) -> Option<Self> {
        if let Some(scene) = QuestionScene::of(question)
            && scene.corners.is_none()
        {
            let is_tree = scene.tree.is_some() || scene.max_leaf_size.is_some();
            return Some(if is_tree {
                Target::Tree(scene.shapes)
            } else {
                Target::Shapes(scene.shapes)
            });
        }
        let bounds = scan::extent(question.table()?.subject())?;
        Some(Target::Box(bounds))
    }

    /// Returns the box around it.
    fn bounds(&self) -> Bounds {
        match self {
            Target::Shapes(shapes) | Target::Tree(shapes) => bounds(shapes),
            Target::Box(bounds) => *bounds,
        }
    }
}

/// Returns the film of a camera.
fn film(subject: &dyn Record) -> Option<UVec2> {
    subject.values().find_map(|value| {
        if let Value::Film(film) = value {
            Some(film)
        } else {
            None
        }
    })
}

/// Returns the pixel in a row of a table.
fn pixel(question: &Question, row: usize) -> Option<UVec2> {
    let input = question.table()?.input(row)?;
    input.values().find_map(|value| {
        if let Value::Pixel(pixel) = value {
            Some(pixel)
        } else {
            None
        }
    })
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
