//! Compares submitted intervals, in which rays are inside a box, with the key.

use protocol::{ElementOutcome, Interval};

use crate::describe;
use crate::judge::measure::{LENGTH, length_error};
use crate::judge::{
    Comparison, Deviation, FailureKind, Judgement, Measurement, Threshold, judge_table,
    measure_table,
};

/// The submitted intervals and their key. Every interval must be correct.
pub(super) struct Spans<'a> {
    /// The scale of each query.
    pub(super) scales: Vec<f32>,
    pub(super) spans: &'a [Option<Interval>],
    pub(super) answers: &'a [ElementOutcome<Option<Interval>>],
}

impl Comparison for Spans<'_> {
    fn judge(&self) -> Judgement {
        judge_table(self.answers, self.spans.len(), |element, got| {
            let wanted = self.spans[element];
            if self.deviation(element, *got).is_right() {
                return None;
            }
            let what = match (got, wanted) {
                (Some(_), Some(_)) => "interval inside the box",
                (Some(_), None) | (None, Some(_)) | (None, None) => "hit or miss",
            };
            Some(FailureKind::Wrong {
                what: what.to_owned(),
                got: describe::span(*got),
                wanted: describe::span(wanted),
            })
        })
    }

    fn measure(&self) -> Vec<Measurement> {
        measure_table(self.answers, self.spans.len(), |element, got| {
            vec![self.deviation(element, *got)]
        })
    }
}

impl Spans<'_> {
    fn deviation(&self, element: usize, got: Option<Interval>) -> Deviation {
        match (got, self.spans[element]) {
            (None, None) => Deviation::RIGHT,
            (Some(_), None) | (None, Some(_)) => Deviation::WRONG,
            (Some(got), Some(wanted)) => {
                let error = |got, wanted| length_error(got, wanted, self.scales[element], LENGTH);
                let (start, end) = (error(got.min, wanted.min), error(got.max, wanted.max));
                Deviation::new(Threshold::Times, start.max(end))
            }
        }
    }
}
