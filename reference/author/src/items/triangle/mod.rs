//! Items of task 2, step 1: triangles.

mod hits;
mod scene;
mod surface;

use judging::exam::ExamQuestion;

use crate::domains::triangle::{Plane, TRIANGLE, tables};
use crate::items::{AuthoredTask, shape_question};
use crate::seed::Rng;

/// The task `triangle`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        hits::INSIDE,
        hits::OUTSIDE,
        surface::POSITION,
        surface::NORMAL,
        surface::UV,
        surface::UV_CORNERS,
        hits::FROM_BEHIND,
        surface::NORMAL_FROM_BEHIND,
        hits::RANGE_MAX,
        hits::RANGE_MIN,
        hits::BEHIND_THE_RAY,
        hits::TINY,
        hits::GRAZING,
        hits::DEGENERATE,
        surface::ORIGIN_AND_MATERIAL,
        scene::PICTURE,
    ],
    domains: &[&TRIANGLE],
    untested: &[(
        "It need not have length one.",
        "The answer is normalised before it is compared.",
    )],
    ..AuthoredTask::NEW
};

/// Creates questions about triangles of these sizes, with rays that `belongs` accepts. Half of the
/// rays hit their triangle.
fn questions(
    rng: &mut Rng,
    judged: &[&str],
    sizes: &[usize],
    belongs: impl Fn(&Plane) -> bool,
) -> Vec<ExamQuestion> {
    let tables = tables(rng, judged, sizes, belongs).into_iter();
    let question = |(shape, rays)| shape_question(judged, shape, rays);
    tables.map(question).collect()
}

/// Returns whether the ray doesn't graze the triangle. A separate item tests grazing rays.
fn is_steep(plane: &Plane) -> bool {
    plane.slope.abs() > 0.1
}

/// Returns whether the ray doesn't pass close to an edge. A separate item tests rays that do.
fn is_well_inside(plane: &Plane) -> bool {
    plane.least_weight().abs() > 0.02
}
