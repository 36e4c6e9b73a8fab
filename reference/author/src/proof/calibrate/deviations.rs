//! The deviations of one solution's answers to one item.

use judging::exam::Item;
use judging::judge::{Deviation, Measurement, Threshold, measure};

use crate::solutions::workbench::Answers;

/// Returns a correct solution's deviations, relative to every threshold that applies. If the
/// solution may lose points for a tree's cost, that cost is ignored.
pub(super) fn of_correct(item: &Item, answers: &Answers, may_lose: bool) -> Vec<Deviation> {
    let deviations = measure_all(item, answers)
        .into_iter()
        .flat_map(|measured| [Some(measured.deviation), measured.count])
        .flatten();
    deviations
        .filter(|deviation| !(may_lose && deviation.threshold == Some(Threshold::SahCost)))
        .collect()
}

/// Returns the deviation that decides whether the item catches a wrong solution: the largest one.
pub(super) fn of_mistake(item: &Item, answers: &Answers) -> Deviation {
    let deciders = measure_all(item, answers)
        .into_iter()
        .map(Measurement::deciding_deviation);
    let worst = deciders.max_by(|a, b| a.value.total_cmp(&b.value));
    worst.unwrap_or(Deviation::RIGHT)
}

fn measure_all(item: &Item, answers: &Answers) -> Vec<Measurement> {
    let Ok(answers) = answers else {
        return vec![Measurement {
            deviation: Deviation::WRONG,
            count: None,
        }];
    };
    let answered = item.questions.iter().zip(answers);
    let measured = answered.flat_map(|(question, answer)| measure(question, answer));
    measured.collect()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use grader::probe::{Crash, Fault};
    use judging::exam::{ExamQuestion, Key};
    use judging::judge::Tolerance;
    use protocol::{Answer, Corners, ElementOutcome, Interval, Query, Question, Ray};

    use super::*;

    /// Returns an item about boxes that the ray enters at 1 and leaves at 2.
    fn item(questions: usize) -> Item {
        let query = Query {
            ray: Ray::new(Vec3::NEG_X, Vec3::X),
            times: Interval::AHEAD,
        };
        let (min, max) = (Vec3::ZERO, Vec3::ONE);
        let question = Question::boxes(Corners { min, max }, vec![query]);
        let key = Key::spans(vec![Some(Interval::new(1.0, 2.0))]);
        let exam_question = ExamQuestion::new(question, key);
        Item::new("bbox.through", 1, vec![exam_question; questions])
    }

    fn entered(at: f32) -> Answer {
        Answer::Spans(vec![ElementOutcome::Value(Some(Interval::new(at, 2.0)))])
    }

    #[test]
    fn the_worst_question_decides_about_a_mistake() {
        let missed = Answer::Spans(vec![ElementOutcome::Value(None)]);
        let value = |answers| of_mistake(&item(2), &Ok(answers)).value;
        let twice = value(vec![entered(1.0002), entered(1.0)]);
        assert!((twice - 2.0).abs() < 0.01, "{twice}");
        assert_eq!(value(vec![entered(1.0002), missed]), f64::INFINITY);
        assert_eq!(value(vec![entered(1.0), entered(1.0)]), 0.0);
    }

    #[test]
    fn a_fault_is_beyond_every_threshold() {
        let fault = Err(Fault::Crashed(Crash::Signal(11)));
        assert_eq!(of_mistake(&item(1), &fault), Deviation::WRONG);
        assert_eq!(of_correct(&item(1), &fault, false), [Deviation::WRONG]);
    }

    #[test]
    fn lists_each_threshold_that_applies_to_a_correct_answer() {
        let found = of_correct(&item(1), &Ok(vec![entered(1.0)]), false);
        let times = Deviation {
            threshold: Some(Threshold::Field(
                "interval inside the box",
                Tolerance::Length,
            )),
            value: 0.0,
        };
        assert_eq!(found, [times]);
    }
}
