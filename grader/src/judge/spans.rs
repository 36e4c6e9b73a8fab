//! Times inside a box.

use protocol::{Interval, Outcome};

use crate::describe;
use crate::judge::measure::{LENGTH, same_length};
use crate::judge::{How, Judgement, table};

pub(super) fn judge(
    spans: &[Option<Interval>],
    answers: &[Outcome<Option<Interval>>],
) -> Judgement {
    table(answers, spans.len(), |element, got| {
        let wanted = spans[element];
        if is_right(*got, wanted) {
            return None;
        }
        let what = match (got, wanted) {
            (Some(_), Some(_)) => "times inside the box",
            (Some(_), None) | (None, Some(_)) | (None, None) => "hit or miss",
        };
        Some(How::Wrong {
            what: what.to_owned(),
            got: describe::span(*got),
            wanted: describe::span(wanted),
        })
    })
}

fn is_right(got: Option<Interval>, wanted: Option<Interval>) -> bool {
    match (got, wanted) {
        (None, None) => true,
        (Some(_), None) | (None, Some(_)) => false,
        (Some(got), Some(wanted)) => {
            same_length(got.min, wanted.min, LENGTH) && same_length(got.max, wanted.max, LENGTH)
        }
    }
}
