//! Checks that directions are spread evenly over the sphere, for functions that may use any formula
//! that does this. The random numbers are part of the exam, so the verdict never changes.

use std::f64::consts::TAU;

use glam::Vec3;
use protocol::{ElementOutcome, LocalDirection};

use super::deviation::worst_by_threshold;
use super::{Comparison, Deviation, Failure, FailureKind, Judgement, Measurement, Threshold};
use crate::symptom::Side;
use crate::types::{FieldType, UnitLength, in_units_of, number};

/// The numbers of bands and sectors that the sphere is divided into. Bands of equal height have
/// equal areas (Archimedes).
const CELLS: [usize; 2] = [8, 8];

/// The numbers of parts that each band and each sector is divided into, so that directions are also
/// spread evenly within the cells. The parts are again counted in [`CELLS`]: part 0 of every band in
/// band 0, and so on, modulo 8.
const PARTS: [usize; 3] = [1, 8, 64];

/// The number of bands that each axis is divided into, and of sectors around it. Each is about as
/// wide as the mean distance between the exam's directions along the axis, so directions that pile
/// up or leave gaps are found even if all [`CELLS`] get their shares.
const SLICES: usize = 8192;

/// The number of directions in each cell.
pub type Counts = [[u32; CELLS[1]]; CELLS[0]];

/// Directions and the maximum χ² of their counts per cell.
pub(super) struct Spread<'a> {
    pub(super) max_chi_squared: f64,
    pub(super) answer: &'a [ElementOutcome<LocalDirection>],
}

impl Spread<'_> {
    /// Returns the deviation of each direction's length from one.
    fn lengths(&self) -> impl Iterator<Item = Deviation> {
        self.answer.iter().map(|outcome| match outcome {
            ElementOutcome::Value(LocalDirection { direction }) => Deviation::new(
                Threshold::UnitLength,
                UnitLength(*direction).error(&protocol::Value::Direction(*direction), 1.0),
            ),
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => Deviation::WRONG,
        })
    }

    /// Returns the largest χ² of the direction counts: per cell, for each size of the parts, and per
    /// slice. Infinite if there are no directions.
    fn chi_squared(&self) -> f64 {
        let cells = PARTS.map(|parts| self.chi_squared_of_parts(parts));
        let slices = [0, 1, 2].map(|axis| self.chi_squared_of_slices(axis));
        let all = cells.into_iter().chain(slices.into_iter().flatten());
        all.fold(0.0, f64::max)
    }

    fn chi_squared_of_parts(&self, parts: usize) -> f64 {
        chi_squared(counts_of_parts(self.answer, parts).as_flattened())
    }

    /// Returns χ² of the numbers of directions in the bands along an axis, and in the sectors around
    /// it, scaled to the number of cells: the distance from its mean is divided by its standard
    /// deviation, and multiplied by that of the cells' χ².
    fn chi_squared_of_slices(&self, axis: usize) -> [f64; 2] {
        let freedom = |count: usize| (count - 1) as f64;
        let [cells, slices] = [CELLS[0] * CELLS[1], SLICES].map(freedom);
        let scaled =
            |counts: Vec<u32>| cells + (chi_squared(&counts) - slices) * (cells / slices).sqrt();
        counts_of_slices(self.answer, axis).map(scaled)
    }

    /// Returns the number of directions in each cell if they are spread evenly.
    fn expected(&self) -> f64 {
        let [bands, sectors] = CELLS;
        self.answer.len() as f64 / (bands * sectors) as f64
    }

    /// Returns the failure to report if the directions are spread unevenly. It names what a student
    /// can count, and then χ².
    fn uneven(&self) -> FailureKind {
        let [chi_squared, limit] =
            [self.chi_squared(), self.max_chi_squared].map(|value| number(value as f32));
        let counts = cell_counts(self.answer);
        let counts = counts.as_flattened();
        let empty = counts.iter().filter(|count| **count == 0).count();
        let cells = format!("{} cells of equal area", counts.len());
        let got = if empty > 0 {
            format!("{empty} of {cells} are empty")
        } else if self.chi_squared_of_parts(1) > self.max_chi_squared {
            let ends = [counts.iter().min(), counts.iter().max()];
            let [fewest, most] = ends.map(|count| count.copied().unwrap_or(0));
            format!("{cells} have from {fewest} to {most} directions each")
        } else {
            format!("{cells} get equal shares, but the directions are uneven within the cells")
        };
        FailureKind::Uneven {
            got: format!("{got} (χ² = {chi_squared})"),
            wanted: format!(
                "about {:.0} directions in each cell (χ² of at most {limit})",
                self.expected()
            ),
        }
    }

    fn spread(&self) -> Deviation {
        let value = in_units_of(self.max_chi_squared, self.chi_squared());
        Deviation::new(Threshold::Spread, value)
    }
}

impl Comparison for Spread<'_> {
    fn judge(&self) -> Judgement {
        let first = self.lengths().position(|length| !length.is_right());
        let (element, kind) = match first.map(|element| (element, &self.answer[element])) {
            Some((element, ElementOutcome::Panicked(panic))) => {
                (element, FailureKind::Panicked(panic.clone()))
            }
            Some((element, ElementOutcome::Skipped)) => {
                (element, FailureKind::Protocol("skipped".to_owned()))
            }
            Some((element, ElementOutcome::Value(LocalDirection { direction }))) => {
                let kind = FailureKind::Wrong {
                    what: "length of the direction".to_owned(),
                    side: direction.is_nan().then_some(Side::NotANumber),
                    got: UnitLength(*direction).text(),
                    wanted: "1".to_owned(),
                };
                (element, kind)
            }
            None if self.spread().is_right() => return Judgement::RIGHT,
            None => (0, self.uneven()),
        };
        Judgement::wrong(Failure {
            element,
            kind,
            count: None,
        })
    }

    fn measure(&self) -> Vec<Measurement> {
        worst_by_threshold(self.lengths().chain([self.spread()]))
    }
}

/// Returns the number of directions in each cell of the sphere. The outer index is the band, from
/// y = -1 to y = 1, and the inner one the sector, counted from +x toward +z.
pub fn cell_counts(answer: &[ElementOutcome<LocalDirection>]) -> Counts {
    counts_of_parts(answer, 1)
}

/// Returns the number of directions in each cell if each band and each sector has this many parts.
fn counts_of_parts(answer: &[ElementOutcome<LocalDirection>], parts: usize) -> Counts {
    let mut counts = [[0; CELLS[1]]; CELLS[0]];
    for outcome in answer {
        if let Some(LocalDirection { direction }) = outcome.value() {
            let [band, sector] = cell(*direction, parts);
            counts[band][sector] += 1;
        }
    }
    counts
}

/// Returns the number of directions in each band along an axis, and in each sector around it.
fn counts_of_slices(answer: &[ElementOutcome<LocalDirection>], axis: usize) -> [Vec<u32>; 2] {
    let mut counts = [vec![0; SLICES], vec![0; SLICES]];
    for outcome in answer {
        if let Some(LocalDirection { direction }) = outcome.value() {
            for (counts, fraction) in counts.iter_mut().zip(fractions(*direction, axis)) {
                counts[part(fraction, SLICES)] += 1;
            }
        }
    }
    counts
}

/// Returns χ² of numbers that should all be equal. Infinite if all are zero.
fn chi_squared(counts: &[u32]) -> f64 {
    let counts = counts.iter().map(|count| f64::from(*count));
    let expected = counts.clone().sum::<f64>() / counts.len() as f64;
    let sum: f64 = counts
        .map(|count| (count - expected).powi(2) / expected)
        .sum();
    if sum.is_nan() { f64::INFINITY } else { sum }
}

/// Returns the band and the sector of the cell that contains a direction, if each band and each
/// sector has this many parts.
fn cell(direction: Vec3, parts: usize) -> [usize; 2] {
    let fractions = fractions(direction, 1);
    [0, 1].map(|index| part(fractions[index], parts * CELLS[index]) % CELLS[index])
}

/// Returns how far a direction is along an axis, from its negative end to its positive one, and how
/// far around it, as fractions. Around +y, the angle is counted from +x toward +z.
fn fractions(direction: Vec3, axis: usize) -> [f64; 2] {
    let direction = direction.as_dvec3();
    let [along, first, second] = [0, 2, 1].map(|step| direction[(axis + step) % 3]);
    let turn = second.atan2(first).rem_euclid(TAU) / TAU;
    [(along + 1.0) / 2.0, turn]
}

/// Returns which of `count` equal parts of `[0, 1)` contains a fraction.
fn part(fraction: f64, count: usize) -> usize {
    // Casts saturate, so a direction on the last border, or without a length, is in some part too.
    ((fraction * count as f64) as usize).min(count - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns directions from pseudorandom points in the unit square.
    fn spread_by(direction: impl Fn(f32, f32) -> Vec3) -> Vec<ElementOutcome<LocalDirection>> {
        // SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
        let random = |n: u64| {
            let mut bits = n.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((bits ^ (bits >> 31)) >> 40) as f32 / (1 << 24) as f32
        };
        let all = (0..64 * 64).map(|n| direction(random(2 * n), random(2 * n + 1)));
        all.map(|direction| ElementOutcome::Value(LocalDirection { direction }))
            .collect()
    }

    fn on_sphere(height: f32, turn: f32) -> Vec3 {
        let radius = (1.0 - height.powi(2)).max(0.0).sqrt();
        let (sin, cos) = (std::f32::consts::TAU * turn).sin_cos();
        Vec3::new(cos * radius, height, sin * radius)
    }

    fn judged(answer: &[ElementOutcome<LocalDirection>]) -> Option<String> {
        let spread = Spread {
            max_chi_squared: 100.0,
            answer,
        };
        let mut measured = spread.measure().into_iter();
        let is_right = measured.all(|one| one.deciding_deviation().is_right());
        let failure = spread.judge().failure;
        assert_eq!(failure.is_none(), is_right);
        match failure?.kind {
            FailureKind::Wrong { what, .. } => Some(what),
            FailureKind::Uneven { got, .. } => Some(got),
            FailureKind::Panicked(_) | FailureKind::Protocol(_) => None,
        }
    }

    #[test]
    fn even_directions_are_right_and_crowded_poles_are_not() {
        let even = spread_by(|x, y| on_sphere(1.0 - 2.0 * x, y));
        assert_eq!(judged(&even), None);
        let turned = spread_by(|x, y| {
            let direction = on_sphere(1.0 - 2.0 * y, x);
            Vec3::new(direction.z, direction.x, direction.y)
        });
        assert_eq!(judged(&turned), None);
        let crowded = spread_by(|x, y| on_sphere((std::f32::consts::PI * x).cos(), y));
        let got = |answer: &[_]| judged(answer).expect("the directions are uneven");
        assert!(got(&crowded).starts_with("64 cells of equal area have from "));
        let half = spread_by(on_sphere);
        assert!(got(&half).starts_with("32 of 64 cells of equal area are empty "));
        // Even from afar, but with only 16 different heights.
        let steps = spread_by(|x, y| on_sphere(((16.0 * x).floor() - 7.5) / 8.0, y));
        assert!(got(&steps).contains("uneven within the cells"));
    }

    #[test]
    fn directions_that_pile_up_within_the_cells_are_uneven() {
        let got = |answer: &[_]| judged(answer).expect("the directions are uneven");
        let rings = spread_by(|x, y| on_sphere((1.0 - 2.0 * x).clamp(-0.99, 0.99), y));
        assert!(got(&rings).contains("uneven within the cells"));
        let degrees = spread_by(|x, y| on_sphere(1.0 - 2.0 * x, (360.0 * y).floor() / 360.0));
        assert!(got(&degrees).contains("uneven within the cells"));
        // A spiral of 1024 points.
        let spiral = spread_by(|x, _| {
            let index = (1024.0 * x).floor();
            on_sphere(
                1.0 - (2.0 * index + 1.0) / 1024.0,
                (0.618_034 * index).fract(),
            )
        });
        assert!(got(&spiral).contains("uneven within the cells"));
    }

    #[test]
    fn directions_without_length_one_are_named() {
        for factor in [0.5, 0.0, f32::NAN] {
            let scaled = spread_by(|x, y| factor * on_sphere(1.0 - 2.0 * x, y));
            assert_eq!(judged(&scaled).as_deref(), Some("length of the direction"));
        }
    }
}
