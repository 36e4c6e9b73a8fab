//! The margins of every threshold: how far the answers of correct solutions and of mistakes are
//! from it.

use std::collections::BTreeMap;
use std::fmt;

use judging::judge::{Deviation, Threshold};

/// The minimum margin. It must be possible to make every threshold stricter or more lenient by this
/// factor without a wrong result.
pub const MIN_MARGIN: f64 = 1.5;

/// The deviation of one solution in one item of one exam.
#[derive(Clone, Debug, PartialEq)]
pub struct DeviationSample {
    /// The deviation of the solution's answers.
    pub deviation: Deviation,
    /// The id of the variant or mistake.
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

/// The deviations nearest to one threshold, on both sides.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Margin {
    /// The largest deviation of a correct solution.
    pub worst_correct: Option<DeviationSample>,
    /// The smallest deviation of a mistake that the threshold catches.
    pub mildest_mistake: Option<DeviationSample>,
}

impl Margin {
    /// Returns the factor by which the threshold could be made stricter before a correct answer
    /// counts as wrong.
    pub fn correct_margin(&self) -> f64 {
        let worst = self.worst_correct.as_ref();
        worst.map_or(f64::INFINITY, |worst| 1.0 / worst.deviation.value)
    }

    /// Returns the factor by which the threshold could be made more lenient before an item stops
    /// catching a mistake.
    pub fn mistake_margin(&self) -> f64 {
        let mildest = self.mildest_mistake.as_ref();
        mildest.map_or(f64::INFINITY, |mildest| mildest.deviation.value)
    }
}

/// The ids of a solution and of an item.
type SolutionAndItem = (String, String);

/// The margins of all thresholds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Margins {
    by_threshold: BTreeMap<Threshold, Margin>,
    /// Correct solutions that fail an item for a reason that has no threshold, with one sample per
    /// solution and item.
    failed_variants: BTreeMap<SolutionAndItem, DeviationSample>,
    /// Mistakes that are caught with too small a margin, or not at all, by an item that they must
    /// fail.
    weak_detections: BTreeMap<SolutionAndItem, DeviationSample>,
}

impl Margins {
    /// Returns the margin of one threshold.
    pub fn margin(&self, threshold: Threshold) -> Margin {
        let known = self.by_threshold.get(&threshold);
        known.cloned().unwrap_or_default()
    }

    /// Adds a deviation of a correct solution.
    pub fn add_correct(&mut self, sample: DeviationSample) {
        match sample.deviation.threshold {
            None if sample.deviation.is_right() => {}
            None => {
                self.failed_variants.entry(sample.key()).or_insert(sample);
            }
            Some(threshold) => {
                let margin = self.by_threshold.entry(threshold).or_default();
                replace_if(&mut margin.worst_correct, sample, |new, old| new > old);
            }
        }
    }

    /// Adds the deciding deviations of one mistake in one exam, in the items that it must fail.
    /// Items that barely catch the mistake count only if no other item catches it clearly: the
    /// lists of items are generated, and also contain items that are about something else.
    pub fn add_mistake_of_exam(&mut self, samples: Vec<DeviationSample>) {
        let is_clear = |sample: &DeviationSample| sample.deviation.value >= MIN_MARGIN;
        let is_caught = samples.iter().any(is_clear);
        let counted = samples.into_iter();
        let counted = counted.filter(|sample| is_clear(sample) || !is_caught);
        counted.for_each(|sample| self.add_mistake(sample));
    }

    /// Adds the deciding deviation of a mistake in an item that it must fail.
    fn add_mistake(&mut self, sample: DeviationSample) {
        let Deviation { threshold, value } = sample.deviation;
        if value < MIN_MARGIN {
            let known = self.weak_detections.entry(sample.key());
            let mild = known.or_insert_with(|| sample.clone());
            if value < mild.deviation.value {
                mild.clone_from(&sample);
            }
        }
        if let Some(threshold) = threshold.filter(|_| value > 1.0 && value.is_finite()) {
            let margin = self.by_threshold.entry(threshold).or_default();
            replace_if(&mut margin.mildest_mistake, sample, |new, old| new < old);
        }
    }

    /// Returns the margins of both sets of samples together.
    pub fn merge(mut self, other: Margins) -> Margins {
        let margins = other.by_threshold.into_values();
        let nearest = margins.map(|margin| (margin.worst_correct, margin.mildest_mistake));
        let (correct, mistakes): (Vec<_>, Vec<_>) = nearest.unzip();
        let correct = correct.into_iter().flatten();
        let correct = correct.chain(other.failed_variants.into_values());
        correct.for_each(|sample| self.add_correct(sample));
        let mistakes = mistakes.into_iter().flatten();
        let mistakes = mistakes.chain(other.weak_detections.into_values());
        mistakes.for_each(|sample| self.add_mistake(sample));
        self
    }

    /// Returns the problems found, one line each.
    pub fn problems(&self) -> Vec<String> {
        let near = Threshold::all().into_iter().filter_map(|threshold| {
            let margin = self.margin(threshold);
            let worst = margin.worst_correct.as_ref()?;
            (margin.correct_margin() < MIN_MARGIN).then(|| too_near(threshold, worst))
        });
        let wrong = self
            .failed_variants
            .values()
            .map(|sample| format!("{sample} is correct but fails: run `cargo author prove`"));
        near.chain(wrong)
            .chain(self.weak_detections.values().map(too_mild))
            .collect()
    }
}

/// Replaces `known` with `new` if there is no known sample, or if `nearer` returns true for the new
/// value and the known one.
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
        "{worst} is correct but reaches {:.2} of the threshold for {} ({}); at most {:.2} is \
         allowed: ask a question with a more precise answer, or tolerate more in {}",
        worst.deviation.value,
        threshold.title(),
        threshold.limit(),
        1.0 / MIN_MARGIN,
        threshold.location(),
    )
}

fn too_mild(mistake: &DeviationSample) -> String {
    let Deviation { threshold, value } = mistake.deviation;
    let threshold = match threshold {
        Some(threshold) => format!("the threshold for {}", threshold.title()),
        None => "any threshold".to_owned(),
    };
    let caught = if value > 1.0 { "barely" } else { "not" };
    format!(
        "{mistake} is {caught} caught: it reaches {value:.2} of {threshold}, and at least \
         {MIN_MARGIN:.2} is required: ask a question that the mistake gets more wrong"
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

    const UV: Option<Threshold> = Some(Threshold::PictureUv);

    #[test]
    fn the_nearest_value_on_each_side_sets_the_margin() {
        let both = |margin: &Margin| (margin.correct_margin(), margin.mistake_margin());
        let right = [0.1, 0.5, 0.2].map(|value| sample(UV, value, 1));
        let wrong = [9.0, 3.0, f64::INFINITY].map(|value| sample(UV, value, 2));
        let margin = margins(&right, &wrong).margin(Threshold::PictureUv);
        assert_eq!(both(&margin), (2.0, 3.0));
        assert_eq!(margin.worst_correct, Some(right[1].clone()));
        assert_eq!(margin.mildest_mistake, Some(wrong[1].clone()));
        assert_eq!(margins(&right, &wrong).problems(), [""; 0]);
        let without_near = margins(&[sample(UV, 0.0, 1)], &[]).margin(Threshold::PictureUv);
        assert_eq!(both(&without_near), (f64::INFINITY, f64::INFINITY));
    }

    #[test]
    fn merging_seeds_gives_the_same_margins_as_adding_them_together() {
        let right = [(0.3, 0), (0.8, 1), (0.1, 2), (0.8, 3)];
        let right = right.map(|(value, seed)| sample(UV, value, seed));
        let wrong = [2.0, 1.2].map(|value| sample(UV, value, 9));
        let halves = margins(&right[..1], &wrong[..1]).merge(margins(&right[1..], &wrong[1..]));
        let whole = margins(&right, &wrong);
        assert_eq!(
            halves.margin(Threshold::PictureUv),
            whole.margin(Threshold::PictureUv)
        );
        assert_eq!(halves.problems(), whole.problems());
    }

    #[test]
    fn barely_caught_counts_only_if_no_item_of_the_exam_catches_clearly() {
        let narrow = sample(UV, 1.2, 9);
        let mut clear = sample(UV, 7.0, 9);
        clear.item = "sphere.uv_radius".to_owned();
        let mut margins = Margins::default();
        margins.add_mistake_of_exam(vec![narrow.clone(), clear]);
        assert_eq!(margins.problems(), [""; 0]);
        assert_eq!(margins.margin(Threshold::PictureUv).mistake_margin(), 7.0);
        margins.add_mistake_of_exam(vec![narrow]);
        assert_eq!(margins.problems().len(), 1);
        assert_eq!(margins.margin(Threshold::PictureUv).mistake_margin(), 1.2);
    }

    #[test]
    fn reports_each_small_margin_and_what_to_do() {
        let right = [sample(UV, 0.75, 7), sample(None, f64::INFINITY, 8)];
        let mut uncaught = sample(None, 0.0, 10);
        uncaught.item = "sphere.uv_radius".to_owned();
        let wrong = [sample(UV, 1.4, 8), sample(UV, 1.25, 9), uncaught];
        let problems = margins(&right, &wrong).problems();
        let expected = [
            "`sphere.some` in `sphere.uv`, seed 7 is correct but reaches 0.75 of the threshold for \
             uv in a picture (2e-3); at most 0.67 is allowed: ask a question with a more precise \
             answer, or tolerate more in types/uv.rs: TOLERANCE",
            "`sphere.some` in `sphere.uv`, seed 8 is correct but fails: run `cargo author prove`",
            "`sphere.some` in `sphere.uv`, seed 9 is barely caught: it reaches 1.25 of the \
             threshold for uv in a picture, and at least 1.50 is required: ask a question that the \
             mistake gets more wrong",
            "`sphere.some` in `sphere.uv_radius`, seed 10 is not caught: it reaches 0.00 of any \
             threshold, and at least 1.50 is required: ask a question that the mistake gets more \
             wrong",
        ];
        assert_eq!(problems, expected);
    }
}
