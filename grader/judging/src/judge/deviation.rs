//! How far an answer is from being right, in units of the threshold that it is held against.

use std::collections::BTreeMap;

use protocol::ElementOutcome;

use super::Threshold;
use super::measure::in_units_of;

/// How far something is from being right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// What it is held against. None where nothing lies between right and wrong: hit or miss, a
    /// panic, nodes that are no tree.
    pub threshold: Option<Threshold>,
    /// In units of the threshold: right up to 1. Never NaN; without a threshold 0 or infinite.
    pub value: f64,
}

impl Deviation {
    /// Right, with nothing between that and wrong.
    pub const RIGHT: Deviation = Deviation {
        threshold: None,
        value: 0.0,
    };
    /// Wrong, with nothing between that and right.
    pub const WRONG: Deviation = Deviation {
        threshold: None,
        value: f64::INFINITY,
    };

    /// Right or wrong, and nothing between.
    pub(super) fn binary(right: bool) -> Self {
        if right { Self::RIGHT } else { Self::WRONG }
    }

    pub(super) fn new(threshold: Threshold, value: f64) -> Self {
        Deviation {
            threshold: Some(threshold),
            value,
        }
    }

    /// Whether it is tolerated.
    pub fn is_right(self) -> bool {
        self.value <= 1.0
    }
}

/// One thing that is asked of an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// How far off it is. Where places are counted, and some may be off, those are passed over: it
    /// is the worst of the others.
    pub deviation: Deviation,
    /// Where places are counted: how many are off.
    pub count: Option<Deviation>,
}

impl Measurement {
    /// What decides about it. Something is wrong only if it is too far off, and that at too many
    /// places: the milder of the two decides.
    pub fn deciding_deviation(self) -> Deviation {
        match self.count {
            Some(count) if count.value < self.deviation.value => count,
            Some(_) | None => self.deviation,
        }
    }

    /// Places of which so many may be off.
    pub(super) fn of_positions(
        mut places: Vec<Deviation>,
        allowed: usize,
        count: Threshold,
    ) -> Self {
        let off = places.iter().filter(|place| !place.is_right()).count();
        places.sort_by(|a, b| b.value.total_cmp(&a.value));
        let next = places.get(allowed).copied();
        Measurement {
            deviation: next.unwrap_or(Deviation::RIGHT),
            count: Some(Deviation::new(
                count,
                in_units_of(allowed as f64, off as f64),
            )),
        }
    }
}

/// What a table comes to, of which every element must be right: the worst by each threshold.
pub(super) fn worst_by_threshold(
    deviations: impl IntoIterator<Item = Deviation>,
) -> Vec<Measurement> {
    let mut worst = BTreeMap::new();
    for Deviation { threshold, value } in deviations {
        let most: &mut f64 = worst.entry(threshold).or_default();
        *most = most.max(value);
    }
    let measured = |(threshold, value)| Measurement {
        deviation: Deviation { threshold, value },
        count: None,
    };
    worst.into_iter().map(measured).collect()
}

/// The deviations of one element: of its value, or that there is none.
pub(super) fn outcome_deviations<T>(
    outcome: &ElementOutcome<T>,
    of_value: impl FnOnce(&T) -> Vec<Deviation>,
) -> Vec<Deviation> {
    match outcome {
        ElementOutcome::Value(value) => of_value(value),
        ElementOutcome::Panicked(_) | ElementOutcome::Skipped => vec![Deviation::WRONG],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depths(values: &[f64]) -> Vec<Deviation> {
        let depth = |value: &f64| Deviation::new(Threshold::PictureDepth, *value);
        values.iter().map(depth).collect()
    }

    #[test]
    fn keeps_the_worst_deviation_of_each_threshold() {
        let length = |value| Deviation::new(Threshold::UnitLength, value);
        let mut all = depths(&[0.2, 0.7]);
        all.extend([length(0.1), length(f64::INFINITY), Deviation::RIGHT]);
        let off: Vec<Deviation> = worst_by_threshold(all)
            .into_iter()
            .map(|measured| measured.deviation)
            .collect();
        let expected = [
            Deviation::RIGHT,
            length(f64::INFINITY),
            Deviation::new(Threshold::PictureDepth, 0.7),
        ];
        assert_eq!(off, expected);
    }

    #[test]
    fn ignores_the_worst_positions_up_to_the_allowed_count() {
        let measured = |values: &[f64]| {
            Measurement::of_positions(depths(values), 2, Threshold::PicturePositions)
        };
        let fine = measured(&[0.1, 9.0, 0.4, f64::INFINITY]);
        assert_eq!(fine.deviation.value, 0.4);
        assert_eq!(fine.count.map(|count| count.value), Some(1.0));
        assert!(fine.deciding_deviation().is_right());

        // Three places are off, by at least 1.2: that is nearer than three of two.
        let wrong = measured(&[0.1, 9.0, 1.2, f64::INFINITY]);
        assert_eq!(
            wrong.deciding_deviation(),
            Deviation::new(Threshold::PictureDepth, 1.2)
        );
        let grossly = measured(&[0.1, 9.0, 8.0, f64::INFINITY]);
        let many = Deviation::new(Threshold::PicturePositions, 1.5);
        assert_eq!(grossly.deciding_deviation(), many);
    }
}
