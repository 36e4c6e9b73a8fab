//! Compares submitted intervals, in which rays are inside a box, with the key.

use protocol::{ElementOutcome, Interval};

use crate::describe;
use crate::judge::measure::{LENGTH, length_error};
use crate::judge::{Deviation, FailureKind, Table, Threshold};

/// The submitted intervals and their key. Every interval must be correct.
pub(super) struct Spans<'a> {
    /// The scale of each query.
    pub(super) scales: Vec<f32>,
    pub(super) spans: &'a [Option<Interval>],
    pub(super) answers: &'a [ElementOutcome<Option<Interval>>],
}

impl Table for Spans<'_> {
    type Value = Option<Interval>;

    fn outcomes(&self) -> &[ElementOutcome<Option<Interval>>] {
        self.answers
    }

    fn count(&self) -> usize {
        self.spans.len()
    }

    fn deviations(&self, element: usize, got: &Option<Interval>) -> Vec<Deviation> {
        vec![match (got, self.spans[element]) {
            (None, None) => Deviation::RIGHT,
            (Some(_), None) | (None, Some(_)) => Deviation::WRONG,
            (Some(got), Some(wanted)) => {
                let error = |got, wanted| length_error(got, wanted, self.scales[element], LENGTH);
                let (start, end) = (error(got.min, wanted.min), error(got.max, wanted.max));
                Deviation::new(Threshold::Times, start.max(end))
            }
        }]
    }

    fn failure(&self, element: usize, got: &Option<Interval>, _: usize) -> FailureKind {
        let wanted = self.spans[element];
        let what = match (got, wanted) {
            (Some(_), Some(_)) => "interval inside the box",
            (Some(_), None) | (None, Some(_)) | (None, None) => "hit or miss",
        };
        FailureKind::Wrong {
            what: what.to_owned(),
            got: describe::span(*got),
            wanted: describe::span(wanted),
        }
    }
}
