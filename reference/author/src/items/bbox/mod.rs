//! Items of task 3, step 0: boxes.

mod almost_parallel;
mod hits;
mod times;

use judging::exam::{ExamQuestion, Key};
use protocol::{Corners, Interval, Question, Ray};

use crate::domains::bbox::{BOX, BoxCall, tables};
use crate::items::AuthoredTask;
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

type Query = (Ray, Interval);

/// The task `bbox`.
pub static TASK: AuthoredTask = AuthoredTask {
    items: &[
        hits::THROUGH,
        hits::SLAB_AFTER_SLAB,
        hits::OCTANTS,
        times::BEHIND,
        times::FROM_INSIDE,
        times::CLIPPED,
        times::WHOLLY_INSIDE,
        times::TIMES_NOT_RANGE,
        hits::AXIS_PARALLEL,
        hits::FLAT,
    ],
    domains: &[&BOX],
    untested: &[(
        "Neither the box nor `times` is ever empty (`min > max`).",
        "This is a promise about the arguments, so there is nothing to test.",
    )],
    ..AuthoredTask::NEW
};

fn bbox_question(bounds: Bounds, queries: Vec<Query>) -> ExamQuestion {
    let expected = |(ray, times): &Query| {
        let span = bounds.span(&Ray64::from(ray).within(*times));
        span.map(|(enter, leave)| Interval::new(enter as f32, leave as f32))
    };
    let spans = queries.iter().map(expected).collect();
    let key = Key::spans(spans);
    let corners = Corners {
        min: bounds.min.as_vec3(),
        max: bounds.max.as_vec3(),
    };
    let queries = queries.into_iter();
    let rows = queries.map(|(ray, times)| protocol::Query { ray, times });
    let question = Question::boxes(corners, rows.collect());
    ExamQuestion::new(question, key)
}

/// Creates questions about boxes of these sizes, with calls that `belongs` accepts. Half of the
/// calls are hits.
fn questions(
    rng: &mut Rng,
    sizes: &[usize],
    belongs: impl Fn(&BoxCall) -> bool,
) -> Vec<ExamQuestion> {
    let tables = tables(rng, sizes, belongs).into_iter();
    tables
        .map(|(bounds, queries)| bbox_question(bounds, queries))
        .collect()
}

/// Returns true if the box isn't flat, the ray isn't parallel to any of its faces, and it doesn't
/// matter whether the ray is almost parallel to one of them. Separate items test the other cases.
fn is_ordinary(call: &BoxCall) -> bool {
    !call.is_flat() && !call.is_parallel() && !call.is_decided_by_slant()
}
