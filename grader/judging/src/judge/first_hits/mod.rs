//! Pictures of first hits, against a key that is a *set* at every position.
//!
//! Near an edge a last bit decides what a ray sees, and every answer that a neighbour within
//! ±5e-4 of a pixel would get is right. Leaving such positions out instead would hide cracks,
//! which are to be found nowhere else.

use std::iter;

use arrayvec::ArrayVec;
use protocol::{ElementOutcome, Trace};

use crate::describe;
use crate::exam::Surface;
use crate::judge::measure::{direction_error, length_error, uv_error};
use crate::judge::{
    Aspect, Comparison, Credit, Deviation, Failure, FailureKind, Judgement, Measurement, Mismatch,
    Threshold, deviation,
};

pub(super) const DEPTH: f32 = 2e-4;
pub(super) const NORMAL: f32 = 5e-3;

/// What is compared, each only where the ones before it are right, with its weight in hundredths.
const QUANTITIES: [(&str, u32); 4] = [
    ("hit or miss", 40),
    ("depth", 30),
    ("normal", 20),
    ("uv", 10),
];

/// The same, for a mask.
const ASPECTS: [Aspect; 4] = [Aspect::HitOrMiss, Aspect::Depth, Aspect::Normal, Aspect::Uv];

/// How far off each quantity is at one position, up to the first that is wrong.
type Deviations = ArrayVec<Deviation, { QUANTITIES.len() }>;

/// A picture.
pub(super) struct FirstHits<'a> {
    pub(super) hits: &'a [Option<Surface>],
    pub(super) alternatives: &'a [(u32, Option<Surface>)],
    pub(super) answers: &'a [ElementOutcome<Option<Trace>>],
}

/// One quantity, wherever it is judged.
#[derive(Clone, Copy, Default)]
struct Tally {
    judged: usize,
    wrong: usize,
    first_wrong: Option<usize>,
}

impl Comparison for FirstHits<'_> {
    fn judge(&self) -> Judgement {
        if self.answers.len() != self.hits.len() {
            return Judgement::protocol("another number of answers than of rays");
        }
        let tallies = self.tallies();
        let shares = tallies.map(|tally| match self.has_enough_judged(tally.judged) {
            true => Credit::by_count(tally.wrong, tally.judged),
            false => Credit::NONE,
        });
        let weighted = QUANTITIES.iter().zip(shares);
        let share = Credit::weighted(weighted.map(|((_, weight), share)| (*weight, share)));
        let worst = (0..QUANTITIES.len()).find(|&quantity| shares[quantity] < Credit::FULL);
        Judgement {
            credit: share,
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
            quantities.for_each(|(places, deviation)| places.push(deviation));
        }
        let measured = |places: Vec<Deviation>| {
            let is_enough = self.has_enough_judged(places.len());
            let allowed = Credit::tolerated(places.len());
            let counted = Measurement::of_positions(places, allowed, Threshold::PicturePositions);
            // What is not judged often enough fails by what comes before it.
            is_enough.then_some(counted)
        };
        of_each.into_iter().filter_map(measured).collect()
    }

    fn mismatches(&self) -> Option<Vec<Option<Mismatch>>> {
        let blemish = |(outcome, deviations): (&ElementOutcome<_>, Deviations)| match outcome {
            ElementOutcome::Panicked(_) | ElementOutcome::Skipped => Some(Mismatch::NO_ANSWER),
            // The last one judged is the first that is wrong.
            ElementOutcome::Value(_) => {
                let wrong = deviations.iter().zip(ASPECTS);
                let mut wrong = wrong.filter(|(deviation, _)| !deviation.is_right());
                wrong.next().map(|(deviation, aspect)| Mismatch {
                    aspect,
                    deviation: deviation.value,
                })
            }
        };
        let is_whole = self.answers.len() == self.hits.len();
        is_whole.then(|| {
            let positions = self.answers.iter().zip(self.deviations_by_position());
            positions.map(blemish).collect()
        })
    }
}

impl FirstHits<'_> {
    /// How far off each quantity is that is judged there, for each position.
    fn deviations_by_position(&self) -> impl Iterator<Item = Deviations> {
        let mut others: Vec<_> = self.alternatives.iter().collect();
        others.sort_by_key(|(position, _)| *position);
        let mut others = others.into_iter().peekable();
        let answers = self.answers.iter().enumerate();
        // There are tens of thousands of positions: what one needs, the next one takes over.
        let mut alike = Vec::new();
        answers.map(move |(position, outcome)| {
            let here = || others.next_if(|(other, _)| *other as usize == position);
            let others = iter::from_fn(here).map(|(_, answer)| answer);
            let right = others.chain([&self.hits[position]]);
            match outcome {
                ElementOutcome::Value(got) => position_deviations(got.as_ref(), right, &mut alike),
                ElementOutcome::Panicked(_) | ElementOutcome::Skipped => {
                    // The next position's come next.
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

    /// Whoever hits nothing has no wrong normals: half of what there is to hit must be judged. Hit
    /// or miss is, everywhere.
    fn has_enough_judged(&self, judged: usize) -> bool {
        let to_hit = self.hits.iter().flatten().count();
        judged * 2 >= to_hit
    }
}

/// How far off each quantity is at one position, from the nearest of the `right` answers in which
/// all before it agree; up to the first that is wrong. A true miss has but the first. What was in
/// `alike` is forgotten.
fn position_deviations<'a>(
    got: Option<&Trace>,
    right: impl Iterator<Item = &'a Option<Surface>>,
    alike: &mut Vec<[Deviation; QUANTITIES.len() - 1]>,
) -> Deviations {
    alike.clear();
    let mut is_miss = false;
    for wanted in right {
        match (got, wanted) {
            (Some(got), Some(wanted)) => alike.push(deviations(got, wanted)),
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

/// How far off a hit is in depth, normal and uv.
fn deviations(got: &Trace, wanted: &Surface) -> [Deviation; QUANTITIES.len() - 1] {
    let depth = length_error(got.distance, wanted.depth, DEPTH);
    let normal = direction_error(got.normal, wanted.normal, NORMAL);
    [
        Deviation::new(Threshold::PictureDepth, depth),
        Deviation::new(Threshold::PictureNormal, normal),
        Deviation::new(Threshold::PictureUv, uv_error(got.uv, wanted.uv)),
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
        ElementOutcome::Skipped => return FailureKind::Protocol("given up".to_owned()),
    };
    let tell = |tell: fn(&Trace) -> String| got.map_or("no hit".to_owned(), tell);
    let want = |want: fn(&Surface) -> String| wanted.map_or("no hit".to_owned(), want);
    let (got, wanted) = match QUANTITIES[quantity].0 {
        "normal" => (
            tell(|trace| describe::point(trace.normal)),
            want(|surface| describe::point(surface.normal)),
        ),
        "uv" => (
            tell(|trace| describe::uv(trace.uv)),
            want(|surface| describe::uv(surface.uv)),
        ),
        _ => (
            tell(|trace| describe::hit_at(trace.distance)),
            want(|surface| describe::hit_at(surface.depth)),
        ),
    };
    FailureKind::Wrong {
        what: QUANTITIES[quantity].0.to_owned(),
        got,
        wanted,
    }
}

#[cfg(test)]
mod tests;
