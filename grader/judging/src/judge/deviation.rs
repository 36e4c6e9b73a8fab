//! Deviations: the errors in an answer, as multiples of their tolerances.

use std::collections::BTreeMap;

use protocol::ElementOutcome;

use super::Threshold;
use crate::types::in_units_of;

/// The error of one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The tolerance the error is compared to. `None` for errors without a size: hit or miss, a
    /// panic, or nodes that don't form a tree.
    pub threshold: Option<Threshold>,
    /// The error as a multiple of the tolerance. Values up to 1 are correct. Never NaN. If there is
    /// no threshold, the value is 0 or infinite.
    pub value: f64,
}

impl Deviation {
    /// The deviation of a correct answer if there is no tolerance.
    pub const RIGHT: Deviation = Deviation {
        threshold: None,
        value: 0.0,
    };
    /// The deviation of a wrong answer if there is no tolerance.
    pub const WRONG: Deviation = Deviation {
        threshold: None,
        value: f64::INFINITY,
    };

    /// Returns [`Deviation::RIGHT`] or [`Deviation::WRONG`].
    pub(super) fn binary(right: bool) -> Self {
        if right { Self::RIGHT } else { Self::WRONG }
    }

    pub(super) fn new(threshold: Threshold, value: f64) -> Self {
        Deviation {
            threshold: Some(threshold),
            value,
        }
    }

    /// Returns whether the error is within the tolerance.
    pub fn is_right(self) -> bool {
        self.value <= 1.0
    }
}

/// The error that one check measured in an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// The error. If some wrong positions are tolerated, that many of the worst positions are
    /// skipped, and this is the largest error at the remaining positions.
    pub deviation: Deviation,
    /// The number of wrong positions, expressed as a deviation. `None` if positions aren't counted.
    pub count: Option<Deviation>,
}

impl Measurement {
    /// Returns the deviation that decides the verdict. A check fails only if errors are too large
    /// and occur at too many positions, so the smaller of the two deviations decides.
    pub fn deciding_deviation(self) -> Deviation {
        match self.count {
            Some(count) if count.value < self.deviation.value => count,
            Some(_) | None => self.deviation,
        }
    }

    /// Measures the positions in a picture. Up to `allowed` positions may be wrong.
    pub(super) fn of_positions(
        mut positions: Vec<Deviation>,
        allowed: usize,
        count: Threshold,
    ) -> Self {
        let wrong = positions
            .iter()
            .filter(|position| !position.is_right())
            .count();
        positions.sort_by(|a, b| b.value.total_cmp(&a.value));
        let next = positions.get(allowed).copied();
        Measurement {
            deviation: next.unwrap_or(Deviation::RIGHT),
            count: Some(Deviation::new(
                count,
                in_units_of(allowed as f64, wrong as f64),
            )),
        }
    }
}

/// Returns the largest deviation for each threshold, for a table where every element must be
/// correct.
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

/// Returns the deviations of one element. An element without a value is wrong.
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
        let worst: Vec<Deviation> = worst_by_threshold(all)
            .into_iter()
            .map(|measured| measured.deviation)
            .collect();
        let expected = [
            Deviation::RIGHT,
            length(f64::INFINITY),
            Deviation::new(Threshold::PictureDepth, 0.7),
        ];
        assert_eq!(worst, expected);
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

        // Three positions are wrong, but only two may be wrong. The smallest of the three errors is
        // 1.2, which is less than 1.5, the ratio of the counts.
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
