//! Items of task 2, step 2: spheres.

mod roots;
mod surface;

use judging::exam::ExamQuestion;

use crate::domains::sphere::{Line, tables};
use crate::items::{DeclaredItem, draw_items, shape_question};
use crate::seed::{Rng, Seed};

/// Returns the items of the task `sphere`.
pub fn items(seed: Seed) -> Vec<DeclaredItem> {
    let all = [
        roots::NEAR_SIDE,
        roots::BESIDE,
        roots::RADIUS,
        roots::BEHIND,
        roots::FROM_INSIDE,
        roots::FAR_ROOT,
        roots::RANGE_MAX,
        roots::RANGE_WITHIN,
        surface::POSITION,
        surface::NORMAL,
        surface::UV,
        surface::UV_RADIUS,
        surface::ORIGIN_AND_MATERIAL,
        surface::PICTURE,
    ];
    draw_items(seed, &all)
}

/// Creates questions about spheres of these sizes. Their rays belong to an idea, and every other one is
/// a hit.
fn questions(
    rng: &mut Rng,
    judged: &[&str],
    sizes: &[usize],
    belongs: impl Fn(&Line) -> bool,
) -> Vec<ExamQuestion> {
    let tables = tables(rng, judged, sizes, belongs).into_iter();
    let question = |(shape, rays)| shape_question(judged, shape, rays);
    tables.map(question).collect()
}
