//! How near right answers and mistakes came to each threshold, and whether that is far enough:
//! pure.

use std::collections::BTreeMap;
use std::fmt;

use grader::judge::{Deviation, Threshold};

/// By this factor at least, every threshold could be stricter or more lenient.
pub const ENOUGH: f64 = 1.5;

/// How far off a solution was, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Sighting {
    /// How far off.
    pub deviation: Deviation,
    /// The variant or the mistake.
    pub of: String,
    /// The item's id.
    pub item: String,
    /// The exam's seed.
    pub seed: u64,
}

impl Sighting {
    fn pair(&self) -> Pair {
        (self.of.clone(), self.item.clone())
    }
}

impl fmt::Display for Sighting {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "`{}` in `{}`, seed {}", self.of, self.item, self.seed)
    }
}

/// Both sides of one threshold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Margin {
    /// The right answer that is nearest to it.
    pub worst: Option<Sighting>,
    /// The mistake that is nearest to it, of those that it tells.
    pub mildest: Option<Sighting>,
}

impl Margin {
    /// How much stricter the threshold could be before a right answer is wrong.
    pub fn of_right(&self) -> f64 {
        let worst = self.worst.as_ref();
        worst.map_or(f64::INFINITY, |worst| 1.0 / worst.deviation.value)
    }

    /// How much more lenient it could be before an item does not tell a mistake.
    pub fn of_wrong(&self) -> f64 {
        let mildest = self.mildest.as_ref();
        mildest.map_or(f64::INFINITY, |mildest| mildest.deviation.value)
    }
}

/// A solution and an item.
type Pair = (String, String);

/// The margins of all thresholds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Margins {
    of: BTreeMap<Threshold, Margin>,
    /// Right solutions that are wrong where no threshold decides, each once for an item.
    wrong: BTreeMap<Pair, Sighting>,
    /// Mistakes that are hardly told by an item that they must fail, or not at all.
    mild: BTreeMap<Pair, Sighting>,
}

impl Margins {
    /// What is known of one threshold.
    pub fn of(&self, threshold: Threshold) -> Margin {
        self.of.get(&threshold).cloned().unwrap_or_default()
    }

    /// Takes note of an answer by a right solution.
    pub fn add_right(&mut self, sighting: Sighting) {
        match sighting.deviation.threshold {
            None if sighting.deviation.is_right() => {}
            None => {
                self.wrong.entry(sighting.pair()).or_insert(sighting);
            }
            Some(threshold) => {
                let margin = self.of.entry(threshold).or_default();
                keep(&mut margin.worst, sighting, |new, old| new > old);
            }
        }
    }

    /// Takes note of what decides about a mistake in an item that it must fail.
    pub fn add_wrong(&mut self, sighting: Sighting) {
        let Deviation { threshold, value } = sighting.deviation;
        if value < ENOUGH {
            let known = self.mild.entry(sighting.pair());
            let mild = known.or_insert_with(|| sighting.clone());
            if value < mild.deviation.value {
                mild.clone_from(&sighting);
            }
        }
        if let Some(threshold) = threshold.filter(|_| value > 1.0 && value.is_finite()) {
            let margin = self.of.entry(threshold).or_default();
            keep(&mut margin.mildest, sighting, |new, old| new < old);
        }
    }

    /// Both together.
    pub fn join(mut self, other: Margins) -> Margins {
        for margin in other.of.into_values() {
            margin.worst.into_iter().for_each(|it| self.add_right(it));
            margin.mildest.into_iter().for_each(|it| self.add_wrong(it));
        }
        other.mild.into_values().for_each(|it| self.add_wrong(it));
        other.wrong.into_values().for_each(|it| self.add_right(it));
        self
    }

    /// What is not as it must be, a line each.
    pub fn complaints(&self) -> Vec<String> {
        let near = Threshold::ALL.into_iter().filter_map(|threshold| {
            let margin = self.of(threshold);
            let worst = margin.worst.as_ref()?;
            (margin.of_right() < ENOUGH).then(|| too_near(threshold, worst))
        });
        let wrong = self
            .wrong
            .values()
            .map(|sighting| format!("{sighting} is right and fails: see `cargo author prove`"));
        near.chain(wrong)
            .chain(self.mild.values().map(too_mild))
            .collect()
    }
}

/// Keeps the new one if its value is `nearer` than that of the one known.
fn keep(known: &mut Option<Sighting>, new: Sighting, nearer: impl Fn(f64, f64) -> bool) {
    match known {
        Some(old) if !nearer(new.deviation.value, old.deviation.value) => {}
        Some(_) | None => *known = Some(new),
    }
}

fn too_near(threshold: Threshold, worst: &Sighting) -> String {
    format!(
        "{worst} is right and comes to {:.2} of {} ({}), where {:.2} is the most: ask of it what \
         can be told more exactly, or tolerate more in {}",
        worst.deviation.value,
        threshold.title(),
        threshold.limit(),
        1.0 / ENOUGH,
        threshold.place(),
    )
}

fn too_mild(mistake: &Sighting) -> String {
    let Deviation { threshold, value } = mistake.deviation;
    let title = threshold.map_or("any threshold", Threshold::title);
    let is = if value > 1.0 { "hardly" } else { "not" };
    format!(
        "{mistake} is {is} told: it comes to {value:.2} of {title}, where {ENOUGH:.2} is the least: \
         ask what it gets more wrong, or take the item out of its `fails`"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sighting(threshold: Option<Threshold>, value: f64, seed: u64) -> Sighting {
        Sighting {
            deviation: Deviation { threshold, value },
            of: "sphere.some".to_owned(),
            item: "sphere.uv".to_owned(),
            seed,
        }
    }

    fn margins(right: &[Sighting], wrong: &[Sighting]) -> Margins {
        let mut margins = Margins::default();
        right.iter().for_each(|it| margins.add_right(it.clone()));
        wrong.iter().for_each(|it| margins.add_wrong(it.clone()));
        margins
    }

    const UV: Option<Threshold> = Some(Threshold::Uv);

    #[test]
    fn the_nearest_of_each_side_makes_the_margin() {
        let right = [0.1, 0.5, 0.2].map(|value| sighting(UV, value, 1));
        let wrong = [9.0, 3.0, f64::INFINITY].map(|value| sighting(UV, value, 2));
        let margin = margins(&right, &wrong).of(Threshold::Uv);
        assert_eq!((margin.of_right(), margin.of_wrong()), (2.0, 3.0));
        assert_eq!(margin.worst, Some(right[1].clone()));
        assert_eq!(margin.mildest, Some(wrong[1].clone()));
        assert_eq!(margins(&right, &wrong).complaints(), [""; 0]);
    }

    #[test]
    fn where_nobody_comes_near_there_is_no_bound() {
        let margin = margins(&[sighting(UV, 0.0, 1)], &[]).of(Threshold::Uv);
        assert_eq!(margin.of_right(), f64::INFINITY);
        assert_eq!(margin.of_wrong(), f64::INFINITY);
        assert!(margin.worst.is_some() && margin.mildest.is_none());
    }

    #[test]
    fn seeds_are_joined_to_what_they_are_together() {
        let values = [0.3, 0.8, 0.1, 0.8].iter().zip(0..);
        let right: Vec<_> = values
            .map(|(value, seed)| sighting(UV, *value, seed))
            .collect();
        let wrong = [2.0, 1.2].map(|value| sighting(UV, value, 9));
        let halves = margins(&right[..1], &wrong[..1]).join(margins(&right[1..], &wrong[1..]));
        let whole = margins(&right, &wrong);
        assert_eq!(halves.of(Threshold::Uv), whole.of(Threshold::Uv));
        assert_eq!(halves.complaints(), whole.complaints());
    }

    #[test]
    fn what_is_too_near_is_named_with_what_to_do() {
        let right = [sighting(UV, 0.75, 7), sighting(None, f64::INFINITY, 8)];
        let mut untold = sighting(None, 0.0, 10);
        untold.item = "sphere.uv_radius".to_owned();
        let wrong = [sighting(UV, 1.4, 8), sighting(UV, 1.25, 9), untold];
        let complaints = margins(&right, &wrong).complaints();
        let expected = [
            "`sphere.some` in `sphere.uv`, seed 7 is right and comes to 0.75 of uv of a hit \
             (2e-3), where 0.67 is the most: ask of it what can be told more exactly, or tolerate \
             more in measure.rs: UV",
            "`sphere.some` in `sphere.uv`, seed 8 is right and fails: see `cargo author prove`",
            "`sphere.some` in `sphere.uv`, seed 9 is hardly told: it comes to 1.25 of uv of a hit, \
             where 1.50 is the least: ask what it gets more wrong, or take the item out of its \
             `fails`",
            "`sphere.some` in `sphere.uv_radius`, seed 10 is not told: it comes to 0.00 of any threshold, \
             where 1.50 is the least: ask what it gets more wrong, or take the item out of its \
             `fails`",
        ];
        assert_eq!(complaints, expected);
    }
}
