//! Times inside a box.

use protocol::{Interval, Outcome};

use crate::describe;
use crate::judge::measure::{LENGTH, length_error};
use crate::judge::{
    Comparison, Deviation, How, Judgement, Measured, Threshold, table, table_measured,
};

/// The times of each shot, of which every one must be right.
pub(super) struct Spans<'a> {
    pub(super) spans: &'a [Option<Interval>],
    pub(super) answers: &'a [Outcome<Option<Interval>>],
}

impl Comparison for Spans<'_> {
    fn judge(&self) -> Judgement {
        table(self.answers, self.spans.len(), |element, got| {
            let wanted = self.spans[element];
            if deviation(*got, wanted).is_right() {
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

    fn measure(&self) -> Vec<Measured> {
        table_measured(self.answers, self.spans.len(), |element, got| {
            vec![deviation(*got, self.spans[element])]
        })
    }
}

fn deviation(got: Option<Interval>, wanted: Option<Interval>) -> Deviation {
    match (got, wanted) {
        (None, None) => Deviation::RIGHT,
        (Some(_), None) | (None, Some(_)) => Deviation::WRONG,
        (Some(got), Some(wanted)) => {
            let start = length_error(got.min, wanted.min, LENGTH);
            let end = length_error(got.max, wanted.max, LENGTH);
            Deviation::of(Threshold::Times, start.max(end))
        }
    }
}
