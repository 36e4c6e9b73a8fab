//! The margins of every threshold, i.e. how far the threshold is from the answers of correct
//! solutions and of mistakes.

use std::collections::BTreeMap;
use std::fmt;

use judging::judge::{Deviation, Threshold};

/// The minimum margin. Making any threshold stricter or more lenient by this factor must not lead
/// to a wrong result.
pub const MIN_MARGIN: f64 = 1.5;

/// One solution's deviation for one item in one exam.
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
    /// Returns how many times stricter the threshold could be made before a correct answer is
    /// judged wrong.
    pub fn correct_margin(&self) -> f64 {
        let worst = self.worst_correct.as_ref();
        worst.map_or(f64::INFINITY, |worst| 1.0 / worst.deviation.value)
    }

    /// Returns how many times more lenient the threshold could be made before an item stops
    /// catching a mistake.
    pub fn mistake_margin(&self) -> f64 {
        let mildest = self.mildest_mistake.as_ref();
        mildest.map_or(f64::INFINITY, |mildest| mildest.deviation.value)
    }
}

/// The purpose a sample is kept for. For each purpose, only the nearest sample is kept.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum SamplePurpose {
    /// The largest deviation of a correct solution.
    WorstCorrect(Threshold),
    /// The smallest deviation of a mistake that the threshold catches.
    MildestMistake(Threshold),
    /// A correct solution fails an item for a reason that doesn't involve a threshold. The fields
    /// are the ids of the solution and the item.
    FailedVariant(String, String),
    /// An item that must catch a mistake catches it with too small a margin or not at all. The
    /// fields are the ids of the mistake and the item.
    WeakDetection(String, String),
}

/// The margins of all thresholds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Margins {
    nearest: BTreeMap<SamplePurpose, DeviationSample>,
}

impl Margins {
    /// Returns the margin of one threshold.
    pub fn margin(&self, threshold: Threshold) -> Margin {
        let kept = |purpose: SamplePurpose| self.nearest.get(&purpose).cloned();
        Margin {
            worst_correct: kept(SamplePurpose::WorstCorrect(threshold)),
            mildest_mistake: kept(SamplePurpose::MildestMistake(threshold)),
        }
    }

    /// Adds a deviation of a correct solution.
    pub fn add_correct(&mut self, sample: DeviationSample) {
        let purpose = match sample.deviation.threshold {
            None if sample.deviation.is_right() => return,
            None => SamplePurpose::FailedVariant(sample.solution.clone(), sample.item.clone()),
            Some(threshold) => SamplePurpose::WorstCorrect(threshold),
        };
        self.keep_nearest(purpose, sample);
    }

    /// Adds the deviations that decide whether one exam catches a mistake, one for each item that
    /// it must fail. Items that barely catch the mistake are only considered if no other item
    /// catches it clearly: the lists of items are generated, so they also contain items that test
    /// something else.
    pub fn add_mistake_of_exam(&mut self, samples: Vec<DeviationSample>) {
        let is_clear = |sample: &DeviationSample| sample.deviation.value >= MIN_MARGIN;
        let is_caught = samples.iter().any(is_clear);
        let counted = samples.into_iter();
        let counted = counted.filter(|sample| is_clear(sample) || !is_caught);
        counted.for_each(|sample| self.add_mistake(sample));
    }

    /// Records by how much a mistake deviates on an item that it must fail.
    fn add_mistake(&mut self, sample: DeviationSample) {
        let Deviation { threshold, value } = sample.deviation;
        if value < MIN_MARGIN {
            let (mistake, item) = (sample.solution.clone(), sample.item.clone());
            self.keep_nearest(SamplePurpose::WeakDetection(mistake, item), sample.clone());
        }
        if let Some(threshold) = threshold.filter(|_| value > 1.0 && value.is_finite()) {
            self.keep_nearest(SamplePurpose::MildestMistake(threshold), sample);
        }
    }

    /// Keeps the sample, unless a sample that is at least as near has already been kept.
    fn keep_nearest(&mut self, purpose: SamplePurpose, sample: DeviationSample) {
        let is_nearer = |known: &DeviationSample| {
            let (new, old) = (sample.deviation.value, known.deviation.value);
            let is_correct = matches!(purpose, SamplePurpose::WorstCorrect(_));
            if is_correct { new > old } else { new < old }
        };
        if self.nearest.get(&purpose).is_none_or(is_nearer) {
            self.nearest.insert(purpose, sample);
        }
    }

    /// Returns the margins for both sets of samples combined.
    pub fn merge(mut self, other: Margins) -> Margins {
        for (purpose, sample) in other.nearest {
            self.keep_nearest(purpose, sample);
        }
        self
    }

    /// Returns the problems found, one line each.
    pub fn problems(&self) -> Vec<String> {
        let near = Threshold::all().into_iter().filter_map(|threshold| {
            let margin = self.margin(threshold);
            let worst = margin.worst_correct.as_ref()?;
            (margin.correct_margin() < MIN_MARGIN).then(|| too_near(threshold, worst))
        });
        let wrong = self.nearest.iter();
        let wrong = wrong.filter_map(|(purpose, sample)| match purpose {
            SamplePurpose::WorstCorrect(_) | SamplePurpose::MildestMistake(_) => None,
            SamplePurpose::FailedVariant(..) => Some(format!(
                "{sample} is correct but fails: run `cargo author prove`"
            )),
            SamplePurpose::WeakDetection(..) => Some(too_mild(sample)),
        });
        near.chain(wrong).collect()
    }
}

fn too_near(threshold: Threshold, worst: &DeviationSample) -> String {
    format!(
        "{worst} is correct but reaches {:.2} times the threshold for {} ({}); at most {:.2} is \
         allowed: add a question that can be answered more precisely, or increase the tolerance in \
         {}",
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
        "{mistake} is {caught} caught: it reaches {value:.2} times {threshold}, and at least \
         {MIN_MARGIN:.2} is required: add a question where the mistake's answer is further off"
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
            "`sphere.some` in `sphere.uv`, seed 7 is correct but reaches 0.75 times the threshold \
             for uv in a picture (2e-3); at most 0.67 is allowed: add a question that can be \
             answered more precisely, or increase the tolerance in types/uv.rs: TOLERANCE",
            "`sphere.some` in `sphere.uv`, seed 8 is correct but fails: run `cargo author prove`",
            "`sphere.some` in `sphere.uv`, seed 9 is barely caught: it reaches 1.25 times the \
             threshold for uv in a picture, and at least 1.50 is required: add a question where \
             the mistake's answer is further off",
            "`sphere.some` in `sphere.uv_radius`, seed 10 is not caught: it reaches 0.00 times any \
             threshold, and at least 1.50 is required: add a question where the mistake's answer \
             is further off",
        ];
        assert_eq!(problems, expected);
    }
}
