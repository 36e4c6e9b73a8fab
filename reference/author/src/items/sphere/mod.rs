//! Items of task 2, step 2: spheres.

mod roots;
mod surface;

use judging::exam::ExamQuestion;

use crate::domains::sphere::{Line, SPHERE, tables};
use crate::items::{AuthoredTask, shape_question};
use crate::seed::Rng;

/// The task `sphere`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
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
    ],
    domains: &[&SPHERE],
    ..AuthoredTask::NEW
};

/// Creates questions about spheres of these sizes, with rays that `belongs` accepts. Half of the
/// rays hit their sphere.
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
