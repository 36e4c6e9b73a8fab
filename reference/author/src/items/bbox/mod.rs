//! Items of task 3, step 0: boxes.

mod almost_parallel;
mod hits;
mod times;

use judging::exam::{ExamQuestion, Key};
use protocol::{Corners, Interval, Question, Ray};

use crate::domains::bbox::{BOX, BoxCall, tables};
use crate::items::{AuthoredTask, POINTS};
use crate::oracle::Ray64;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

type Query = (Ray, Interval);

/// The sizes of most boxes. Smaller ones are asked where an absolute number could decide.
const USUAL: &[usize] = &[5, 4, 6, 7, 8];

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
    domain: Some(&BOX),
    points: POINTS,
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

/// Creates questions about boxes of these sizes. Their calls belong to an idea, and every other one is a
/// hit.
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

/// Returns whether neither the box is flat nor the ray parallel to one of its faces, which are ideas of
/// two items.
fn is_ordinary(call: &BoxCall) -> bool {
    !call.is_flat() && !call.is_parallel()
}
