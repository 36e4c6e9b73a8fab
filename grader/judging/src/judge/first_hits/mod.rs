//! Compares pictures of first hits with a key that allows a *set* of answers at every position.
//!
//! Near an edge, rounding decides which surface a ray hits, so an answer is correct if a ray moved
//! by up to ±5e-4 of a pixel would produce it. Simply skipping these positions would hide cracks
//! between triangles, which occur nowhere else.

use std::iter;

use arrayvec::ArrayVec;
use protocol::{ElementOutcome, Trace};

use crate::describe;
use crate::exam::Surface;
use crate::judge::{
    Aspect, Comparison, Credit, Deviation, Failure, FailureKind, Judgement, Measurement, Position,
    Threshold, deviation,
};
use crate::symptom::Side;
use crate::types::{direction, length, uv};

pub(super) const DEPTH: f32 = 2e-4;
pub(super) const NORMAL: f32 = 5e-3;

/// The compared quantities and their weights in hundredths. A quantity is only judged at positions
/// where all quantities before it are correct.
const QUANTITIES: [(Aspect, u32); 4] = [
    (Aspect::HitOrMiss, 40),
    (Aspect::Depth, 30),
    (Aspect::Normal, 20),
    (Aspect::Uv, 10),
];

/// The deviations of the quantities at one position, up to the first wrong quantity.
type Deviations = ArrayVec<Deviation, { QUANTITIES.len() }>;

/// A picture and its key.
pub(super) struct FirstHits<'a> {
    /// The scale of the scene: the largest coordinate of the scene and the eye.
    pub(super) scale: f32,
    pub(super) hits: &'a [Option<Surface>],
    pub(super) alternatives: &'a [(u32, Option<Surface>)],
    pub(super) answers: &'a [ElementOutcome<Option<Trace>>],
}

/// The results for one quantity at all positions where it is judged.
#[derive(Clone, Copy, Default)]
struct Tally {
    judged: usize,
    wrong: usize,
    first_wrong: Option<usize>,
}

impl Comparison for FirstHits<'_> {
    fn judge(&self) -> Judgement {
        if self.answers.len() != self.hits.len() {
            return Judgement::protocol("the number of answers differs from the number of rays");
        }
        let tallies = self.tallies();
        let credits = tallies.map(|tally| {
            if self.has_enough_judged(tally.judged) {
                Credit::by_count(tally.wrong, tally.judged)
            } else {
                Credit::NONE
            }
        });
        let weighted = QUANTITIES.iter().zip(credits);
        let credit = Credit::weighted(weighted.map(|((_, weight), credit)| (*weight, credit)));
        let worst = (0..QUANTITIES.len()).find(|&quantity| credits[quantity] < Credit::FULL);
        Judgement {
            credit,
            failure: worst.map(|quantity| {
                let tally = tallies[quantity];
                let element = tally.first_wrong.unwrap_or(0);
                Failure {
                    element,
                    kind: failure_kind(
                        quantity,
                        &self.answers[element],
                        self.hits[element].as_ref(),
                    ),
                    count: Some((tally.wrong, tally.judged)),
                }
            }),
        }
    }

    fn measure(&self) -> Vec<Measurement> {
        if self.answers.len() != self.hits.len() {
            return deviation::worst_by_threshold([Deviation::WRONG]);
        }
        let mut of_each: [Vec<Deviation>; QUANTITIES.len()] = Default::default();
        for deviations in self.deviations_by_position() {
            let quantities = of_each.iter_mut().zip(deviations);
            quantities.for_each(|(positions, deviation)| positions.push(deviation));
        }
        let measured = |positions: Vec<Deviation>| {
            let is_enough = self.has_enough_judged(positions.len());
            let allowed = Credit::tolerated(positions.len());
            let counted =
                Measurement::of_positions(positions, allowed, Threshold::PicturePositions);
            // If a quantity is judged at too few positions, an earlier quantity has already failed.
            is_enough.then_some(counted)
        };
        of_each.into_iter().filter_map(measured).collect()
    }

    fn positions(&self) -> Option<Vec<Position>> {
        let position = |(outcome, deviations): (&ElementOutcome<_>, Deviations)| {
            outcome.value()?;
            let aspects = QUANTITIES.map(|(aspect, _)| aspect);
            Some(aspects.into_iter().zip(deviations).collect())
        };
        let is_whole = self.answers.len() == self.hits.len();
        is_whole.then(|| {
            let positions = self.answers.iter().zip(self.deviations_by_position());
            positions.map(position).collect()
        })
    }
}

impl FirstHits<'_> {
    /// Returns, for each position, the deviations of the quantities that are judged there.
    fn deviations_by_position(&self) -> impl Iterator<Item = Deviations> {
        let mut others: Vec<_> = self.alternatives.iter().collect();
        others.sort_by_key(|(position, _)| *position);
        let mut others = others.into_iter().peekable();
        let answers = self.answers.iter().enumerate();
        // Reused, because allocating a buffer for each of tens of thousands of positions would be
        // slow.
        let mut alike = Vec::new();
        answers.map(move |(position, outcome)| {
            let here = || others.next_if(|(other, _)| *other as usize == position);
            let others = iter::from_fn(here).map(|(_, answer)| answer);
            let right = others.chain([&self.hits[position]]);
            match outcome {
                ElementOutcome::Value(got) => {
                    position_deviations(got.as_ref(), right, self.scale, &mut alike)
                }
                ElementOutcome::Panicked(_) | ElementOutcome::Skipped => {
                    // Consume the alternatives of this position, so that the next position's
                    // alternatives come first.
                    right.for_each(drop);
                    Deviations::from_iter([Deviation::WRONG])
                }
            }
        })
    }

    fn tallies(&self) -> [Tally; QUANTITIES.len()] {
        let mut tallies: [Tally; QUANTITIES.len()] = Default::default();
        for (position, deviations) in self.deviations_by_position().enumerate() {
            for (tally, deviation) in tallies.iter_mut().zip(deviations) {
                tally.judged += 1;
                if !deviation.is_right() {
                    tally.wrong += 1;
                    tally.first_wrong.get_or_insert(position);
                }
            }
        }
        tallies
    }

    /// Returns whether a quantity was judged at half or more of the positions where the key has a
    /// hit. Without this condition, an answer without hits would earn points for its normals, since
    /// none of them are wrong. Hit or miss is judged everywhere.
    fn has_enough_judged(&self, judged: usize) -> bool {
        let to_hit = self.hits.iter().flatten().count();
        judged * 2 >= to_hit
    }
}

/// Returns the deviations at one position, up to the first wrong quantity. For each quantity, the
/// submitted answer is compared with the closest of the answers in `right` that agree with it in
/// all earlier quantities. A correct miss consists only of the first quantity. `alike` is a buffer
/// whose contents are overwritten.
fn position_deviations<'a>(
    got: Option<&Trace>,
    right: impl Iterator<Item = &'a Option<Surface>>,
    scale: f32,
    alike: &mut Vec<[Deviation; QUANTITIES.len() - 1]>,
) -> Deviations {
    alike.clear();
    let mut is_miss = false;
    for wanted in right {
        match (got, wanted) {
            (Some(got), Some(wanted)) => alike.push(deviations(got, wanted, scale)),
            (None, None) => is_miss = true,
            (Some(_), None) | (None, Some(_)) => {}
        }
    }

    let mut nearest = Deviations::new();
    nearest.push(Deviation::binary(is_miss || !alike.is_empty()));
    for quantity in 0..QUANTITIES.len() - 1 {
        let of_each = alike.iter().map(|deviations| deviations[quantity]);
        let Some(next) = of_each.min_by(|a, b| a.value.total_cmp(&b.value)) else {
            break;
        };
        nearest.push(next);
        alike.retain(|deviations| deviations[quantity].is_right());
    }
    nearest
}

/// Returns the deviations of a hit in depth, normal and uv.
fn deviations(got: &Trace, wanted: &Surface, scale: f32) -> [Deviation; QUANTITIES.len() - 1] {
    let depth = length::error(got.distance, wanted.depth, scale, DEPTH);
    let normal = direction::error(got.normal, wanted.normal, NORMAL);
    [
        Deviation::new(Threshold::PictureDepth, depth),
        Deviation::new(Threshold::PictureNormal, normal),
        Deviation::new(Threshold::PictureUv, uv::error(got.uv, wanted.uv)),
    ]
}

fn failure_kind(
    quantity: usize,
    answer: &ElementOutcome<Option<Trace>>,
    wanted: Option<&Surface>,
) -> FailureKind {
    let got = match answer {
        ElementOutcome::Value(got) => got.as_ref(),
        ElementOutcome::Panicked(panic) => return FailureKind::Panicked(panic.clone()),
        ElementOutcome::Skipped => return FailureKind::Protocol("skipped".to_owned()),
    };
    let (aspect, _) = QUANTITIES[quantity];
    let text = |hit: Option<Surface>| match (aspect, hit) {
        (_, None) => "no hit".to_owned(),
        (Aspect::Normal, Some(hit)) => describe::point(hit.normal),
        (Aspect::Uv, Some(hit)) => describe::uv(hit.uv),
        (_, Some(hit)) => format!("a hit at distance {}", describe::number(hit.depth)),
    };
    let nan = |is_nan: bool| is_nan.then_some(Side::NotANumber);
    let side = match aspect {
        Aspect::HitOrMiss => Some(Side::of_presence(got.is_some())),
        Aspect::Depth => got
            .zip(wanted)
            .and_then(|(got, wanted)| Side::of(got.distance, wanted.depth)),
        Aspect::Normal => got.and_then(|got| nan(got.normal.is_nan())),
        Aspect::Uv => got.and_then(|got| nan(got.uv.is_nan())),
        Aspect::NoAnswer | Aspect::Direction | Aspect::Radiance => None,
    };
    FailureKind::Wrong {
        what: aspect.name().to_owned(),
        side,
        got: text(got.map(Surface::from)),
        wanted: text(wanted.copied()),
    }
}

#[cfg(test)]
mod tests;
