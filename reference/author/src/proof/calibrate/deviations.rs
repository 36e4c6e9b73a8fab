//! What one solution's answers to one item come to: pure.

use grader::exam::Item;
use grader::judge::{Deviation, Measurement, Threshold, measure};
use grader::probe::Fault;
use protocol::Answer;

/// An answer to each question of an item, or why there is none.
pub(super) type Answers = Result<Vec<Answer>, Fault>;

/// How far off a right solution is, by all that it is held against. What a tree costs is not held
/// against a solution that may lose points for it.
pub(super) fn of_correct(item: &Item, answers: &Answers, may_lose: bool) -> Vec<Deviation> {
    let held = measure_all(item, answers)
        .into_iter()
        .flat_map(|measured| [Some(measured.deviation), measured.count])
        .flatten();
    held.filter(|deviation| !(may_lose && deviation.threshold == Some(Threshold::SahCost)))
        .collect()
}

/// What tells a wrong solution, if anything does: the item is as wrong as the worst in it.
pub(super) fn of_mistake(item: &Item, answers: &Answers) -> Deviation {
    let deciders = measure_all(item, answers)
        .into_iter()
        .map(Measurement::deciding_deviation);
    let worst = deciders.max_by(|a, b| a.value.total_cmp(&b.value));
    worst.unwrap_or(Deviation::RIGHT)
}

fn measure_all(item: &Item, answers: &Answers) -> Vec<Measurement> {
    let wrong = Measurement {
        deviation: Deviation::WRONG,
        count: None,
    };
    match answers {
        Err(_) => vec![wrong],
        Ok(answers) => {
            let asked = item.questions.iter().zip(answers);
            asked
                .flat_map(|(asked, answer)| measure(asked, answer))
                .collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use grader::exam::{ExamQuestion, Key, Task};
    use grader::probe::Crash;
    use grader::signatures::MistakeSignatures;
    use protocol::{ElementOutcome, Interval, Question, Ray};

    use super::*;

    /// Boxes that are entered after 1 and left after 2.
    fn item(questions: usize) -> Item {
        let question = Question::BBox {
            min: Vec3::ZERO,
            max: Vec3::ONE,
            queries: vec![(Ray::new(Vec3::NEG_X, Vec3::X), Interval::AHEAD)],
        };
        let key = Key::Spans {
            spans: vec![Some(Interval::new(1.0, 2.0))],
        };
        let asked = ExamQuestion::new(question, key);
        Item {
            id: "bbox.through".to_owned(),
            title: String::new(),
            task: Task::BBox,
            points: 1,
            look: String::new(),
            section: None,
            needs: Vec::new(),
            questions: vec![asked; questions],
            signatures: MistakeSignatures::default(),
        }
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
            threshold: Some(Threshold::Times),
            value: 0.0,
        };
        assert_eq!(found, [times]);
    }
}
