//! How near right answers and mistakes came to each threshold, and whether that is far enough:
//! pure.

use std::collections::BTreeMap;
use std::fmt;

use grader::judge::{Deviation, Threshold};

/// By this factor at least, every threshold could be stricter or more lenient.
pub const MIN_MARGIN: f64 = 1.5;

/// How far off a solution was, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct DeviationSample {
    /// How far off.
    pub deviation: Deviation,
    /// The variant or the mistake.
    pub solution: String,
    /// The item's id.
    pub item: String,
    /// The exam's seed.
    pub seed: u64,
}

impl DeviationSample {
    fn key(&self) -> SolutionAndItem {
        (self.solution.clone(), self.item.clone())
    }
}

impl fmt::Display for DeviationSample {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "`{}` in `{}`, seed {}",
            self.solution, self.item, self.seed
        )
    }
}

/// Both sides of one threshold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Margin {
    /// The right answer that is nearest to it.
    pub worst_correct: Option<DeviationSample>,
    /// The mistake that is nearest to it, of those that it tells.
    pub mildest_mistake: Option<DeviationSample>,
}

impl Margin {
    /// How much stricter the threshold could be before a right answer is wrong.
    pub fn correct_margin(&self) -> f64 {
        let worst = self.worst_correct.as_ref();
        worst.map_or(f64::INFINITY, |worst| 1.0 / worst.deviation.value)
    }

    /// How much more lenient it could be before an item does not tell a mistake.
    pub fn mistake_margin(&self) -> f64 {
        let mildest = self.mildest_mistake.as_ref();
        mildest.map_or(f64::INFINITY, |mildest| mildest.deviation.value)
    }
}

/// A solution and an item.
type SolutionAndItem = (String, String);

/// The margins of all thresholds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Margins {
    by_threshold: BTreeMap<Threshold, Margin>,
    /// Right solutions that are wrong where no threshold decides, each once for an item.
    failed_variants: BTreeMap<SolutionAndItem, DeviationSample>,
    /// Mistakes that are hardly told by an item that they must fail, or not at all.
    weak_detections: BTreeMap<SolutionAndItem, DeviationSample>,
}

impl Margins {
    /// What is known of one threshold.
    pub fn margin(&self, threshold: Threshold) -> Margin {
        self.by_threshold
            .get(&threshold)
            .cloned()
            .unwrap_or_default()
    }

    /// Takes note of an answer by a right solution.
    pub fn add_correct(&mut self, sighting: DeviationSample) {
        match sighting.deviation.threshold {
            None if sighting.deviation.is_right() => {}
            None => {
                self.failed_variants
                    .entry(sighting.key())
                    .or_insert(sighting);
            }
            Some(threshold) => {
                let margin = self.by_threshold.entry(threshold).or_default();
                replace_if(&mut margin.worst_correct, sighting, |new, old| new > old);
            }
        }
    }

    /// Takes note of what decides about a mistake in an item that it must fail.
    pub fn add_mistake(&mut self, sighting: DeviationSample) {
        let Deviation { threshold, value } = sighting.deviation;
        if value < MIN_MARGIN {
            let known = self.weak_detections.entry(sighting.key());
            let mild = known.or_insert_with(|| sighting.clone());
            if value < mild.deviation.value {
                mild.clone_from(&sighting);
            }
        }
        if let Some(threshold) = threshold.filter(|_| value > 1.0 && value.is_finite()) {
            let margin = self.by_threshold.entry(threshold).or_default();
            replace_if(&mut margin.mildest_mistake, sighting, |new, old| new < old);
        }
    }

    /// Both together.
    pub fn merge(mut self, other: Margins) -> Margins {
        for margin in other.by_threshold.into_values() {
            margin
                .worst_correct
                .into_iter()
                .for_each(|it| self.add_correct(it));
            margin
                .mildest_mistake
                .into_iter()
                .for_each(|it| self.add_mistake(it));
        }
        other
            .weak_detections
            .into_values()
            .for_each(|it| self.add_mistake(it));
        other
            .failed_variants
            .into_values()
            .for_each(|it| self.add_correct(it));
        self
    }

    /// What is not as it must be, a line each.
    pub fn problems(&self) -> Vec<String> {
        let near = Threshold::ALL.into_iter().filter_map(|threshold| {
            let margin = self.margin(threshold);
            let worst = margin.worst_correct.as_ref()?;
            (margin.correct_margin() < MIN_MARGIN).then(|| too_near(threshold, worst))
        });
        let wrong = self
            .failed_variants
            .values()
            .map(|sighting| format!("{sighting} is right and fails: see `cargo author prove`"));
        near.chain(wrong)
            .chain(self.weak_detections.values().map(too_mild))
            .collect()
    }
}

/// Keeps the new one if its value is `nearer` than that of the one known.
fn replace_if(
    known: &mut Option<DeviationSample>,
    new: DeviationSample,
    nearer: impl Fn(f64, f64) -> bool,
) {
    match known {
        Some(old) if !nearer(new.deviation.value, old.deviation.value) => {}
        Some(_) | None => *known = Some(new),
    }
}

fn too_near(threshold: Threshold, worst: &DeviationSample) -> String {
    format!(
        "{worst} is right and comes to {:.2} of {} ({}), where {:.2} is the most: ask of it what \
         can be told more exactly, or tolerate more in {}",
        worst.deviation.value,
        threshold.title(),
        threshold.limit(),
        1.0 / MIN_MARGIN,
        threshold.location(),
    )
}

fn too_mild(mistake: &DeviationSample) -> String {
    let Deviation { threshold, value } = mistake.deviation;
    let title = threshold.map_or("any threshold", Threshold::title);
    let is = if value > 1.0 { "hardly" } else { "not" };
    format!(
        "{mistake} is {is} told: it comes to {value:.2} of {title}, where {MIN_MARGIN:.2} is the least: \
         ask what it gets more wrong, or take the item out of its `fails`"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(threshold: Option<Threshold>, value: f64, seed: u64) -> DeviationSample {
        DeviationSample {
            deviation: Deviation { threshold, value },
            solution: "sphere.some".to_owned(),
            item: "sphere.uv".to_owned(),
            seed,
        }
    }

    fn margins(right: &[DeviationSample], wrong: &[DeviationSample]) -> Margins {
        let mut margins = Margins::default();
        right.iter().for_each(|it| margins.add_correct(it.clone()));
        wrong.iter().for_each(|it| margins.add_mistake(it.clone()));
        margins
    }

    const UV: Option<Threshold> = Some(Threshold::Uv);

    #[test]
    fn the_nearest_value_on_each_side_sets_the_margin() {
        let right = [0.1, 0.5, 0.2].map(|value| sample(UV, value, 1));
        let wrong = [9.0, 3.0, f64::INFINITY].map(|value| sample(UV, value, 2));
        let margin = margins(&right, &wrong).margin(Threshold::Uv);
        assert_eq!(
            (margin.correct_margin(), margin.mistake_margin()),
            (2.0, 3.0)
        );
        assert_eq!(margin.worst_correct, Some(right[1].clone()));
        assert_eq!(margin.mildest_mistake, Some(wrong[1].clone()));
        assert_eq!(margins(&right, &wrong).problems(), [""; 0]);
    }

    #[test]
    fn margins_are_infinite_without_a_near_value() {
        let margin = margins(&[sample(UV, 0.0, 1)], &[]).margin(Threshold::Uv);
        assert_eq!(margin.correct_margin(), f64::INFINITY);
        assert_eq!(margin.mistake_margin(), f64::INFINITY);
        assert!(margin.worst_correct.is_some() && margin.mildest_mistake.is_none());
    }

    #[test]
    fn merging_seeds_gives_the_same_margins_as_adding_them_together() {
        let values = [0.3, 0.8, 0.1, 0.8].iter().zip(0..);
        let right: Vec<_> = values
            .map(|(value, seed)| sample(UV, *value, seed))
            .collect();
        let wrong = [2.0, 1.2].map(|value| sample(UV, value, 9));
        let halves = margins(&right[..1], &wrong[..1]).merge(margins(&right[1..], &wrong[1..]));
        let whole = margins(&right, &wrong);
        assert_eq!(halves.margin(Threshold::Uv), whole.margin(Threshold::Uv));
        assert_eq!(halves.problems(), whole.problems());
    }

    #[test]
    fn reports_each_small_margin_and_what_to_do() {
        let right = [sample(UV, 0.75, 7), sample(None, f64::INFINITY, 8)];
        let mut untold = sample(None, 0.0, 10);
        untold.item = "sphere.uv_radius".to_owned();
        let wrong = [sample(UV, 1.4, 8), sample(UV, 1.25, 9), untold];
        let complaints = margins(&right, &wrong).problems();
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
