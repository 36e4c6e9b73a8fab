//! Explains a task's wrong answers with known mistakes or with clues for the whole task. The
//! functions here are pure.

use judging::assignment::TaskInfo;
use judging::exam::{Exam, Item};
use judging::recognise::Observations;

use crate::handed_out::HandedOut;
use crate::score::{ItemScore, Verdict, VerdictKind};
use crate::verdict::{add_clue, add_hints};

/// Adds the hints for the mistakes that explain a task's answers, both those of the submission's
/// own program and those of the program with substituted parts. If no mistake explains them and no
/// ray hits anything, adds the clue for that.
pub fn explain_items(
    exam: &Exam,
    lines: &mut [ItemScore],
    own: &Observations,
    substituted: Option<&Observations>,
    handed_out: &HandedOut,
) {
    for line in lines.iter_mut().filter(|line| can_have_hint(&line.verdict)) {
        let observations = match substituted {
            Some(substituted) if line.carried_forward => substituted,
            Some(_) | None => own,
        };
        if let Some(item) = exam.items.iter().find(|item| item.id == line.id) {
            add_hints(line, &observations.explain(exam, item));
            let info = handed_out.assignment.info(item.task);
            let of_task = exam.items.iter().filter(|other| other.task == item.task);
            if is_whole_task(of_task.clone(), info) && observations.misses_everything(of_task) {
                add_clue(line, info.clues.if_nothing_is_hit);
            }
        }
    }
}

/// Returns whether these are all items of a task. After a save, only the items that failed before
/// are graded first, and rays of the other items may hit something.
fn is_whole_task<'a>(items: impl Iterator<Item = &'a Item>, info: &TaskInfo) -> bool {
    items.map(|item| item.points).sum::<u32>() == info.points
}

/// Returns whether a hint is possible: there is a wrong answer, or a known reason for a missing
/// one.
fn can_have_hint(verdict: &Verdict) -> bool {
    // Invalid answers say nothing about the mistake.
    matches!(verdict.kind(), VerdictKind::Failed | VerdictKind::NoAnswer)
        && *verdict != Verdict::Protocol
}

#[cfg(test)]
mod tests {
    use judging::exam::Key;
    use judging::observe::observe;
    use judging::signatures::{KnownMistake, MistakeAnswers};
    use protocol::{Answer, ElementOutcome, Interval};

    use super::*;
    use crate::handed_out::RAYS;
    use crate::score::Hint;
    use crate::score::tests::small_exam::{boxes, exam, pending};
    use crate::score::tests::verdicts;

    #[test]
    fn hints_come_from_the_answers_that_count() {
        let mut exam = exam(&["bbox.flat", "bbox.behind", "bbox.clipped"]);
        exam.mistakes.push(KnownMistake {
            id: "bbox.swap".to_owned(),
            nudge: String::new(),
            hint: "swapped".to_owned(),
            section: None,
        });
        let spans = |span| [Answer::Spans(vec![ElementOutcome::Value(span); 3])];
        let (right, wrong) = (spans(None), spans(Some(Interval { min: 1.0, max: 2.0 })));
        // The mistake doesn't affect the third item.
        for item in &mut exam.items[..2] {
            item.questions = vec![boxes(3)];
            item.signatures.elements = (0..3).collect();
            item.signatures.correct_answers = observe(item, &right);
            item.signatures.mistake_answers.push(MistakeAnswers {
                mistakes: vec![0],
                answers: (0..).zip(observe(item, &wrong)).collect(),
            });
        }
        let observations = |answers: &[Answer]| {
            let mut observations = Observations::default();
            for item in &exam.items {
                observations.record(item, Ok(answers));
            }
            observations
        };
        let (right, wrong) = (observations(&right), observations(&wrong));
        // The first item is graded with substituted parts. The second isn't.
        let hinted = |verdict: Verdict, own: &Observations, substituted: Option<&Observations>| {
            let mut lines: Vec<ItemScore> = pending(&exam).items().cloned().collect();
            lines[0].carried_forward = true;
            for line in &mut lines {
                line.verdict = verdict.clone();
            }
            explain_items(&exam, &mut lines, own, substituted, &RAYS);
            assert!(lines[2].hints.is_empty());
            [0, 1].map(|line| lines[line].hints.len())
        };
        assert_eq!(hinted(Verdict::Wrong, &wrong, None), [1, 1]);
        assert_eq!(hinted(Verdict::Wrong, &right, Some(&wrong)), [1, 0]);
        assert_eq!(hinted(Verdict::Wrong, &wrong, Some(&right)), [0, 1]);
        assert_eq!(hinted(Verdict::Pass, &wrong, Some(&wrong)), [0, 0]);
    }

    #[test]
    fn a_clue_says_that_not_one_ray_hits_unless_a_hint_says_more() {
        let mut whole = exam(&["bbox.flat", "bbox.behind", "bbox.clipped", "bbox.slabs"]);
        for (item, points) in whole.items.iter_mut().zip([4, 2, 2, 2]) {
            item.points = points;
            item.questions = vec![boxes(3)];
            item.questions[0].key = Key::spans(vec![Some(Interval::AHEAD); 3]);
        }
        let miss = ElementOutcome::Value(None);
        let hit = ElementOutcome::Value(Some(Interval::AHEAD));
        // Returns the clue in an item's score if all items are answered with two misses and `last`.
        let clue_in = |line: &ItemScore, exam: &Exam, last: &ElementOutcome<_>| {
            let mut observations = Observations::default();
            for item in &exam.items {
                let spans = vec![miss.clone(), miss.clone(), last.clone()];
                observations.record(item, Ok(&[Answer::Spans(spans)]));
            }
            let mut lines = [line.clone()];
            explain_items(exam, &mut lines, &observations, None, &RAYS);
            lines[0].clue.clone()
        };
        let wrong = ItemScore {
            verdict: Verdict::Wrong,
            ..pending(&whole).items().next().unwrap().clone()
        };
        let bbox = RAYS.assignment.find("bbox").unwrap();
        let clue = bbox.clues.if_nothing_is_hit.map(str::to_owned);
        assert!(clue.is_some());
        assert_eq!(clue_in(&wrong, &whole, &miss), clue);
        assert_eq!(clue_in(&wrong, &whole, &hit), None);
        // A question that isn't asked could have been a hit.
        let mut some = whole.clone();
        some.items.pop();
        assert_eq!(clue_in(&wrong, &some, &miss), None);

        let timed_out = ItemScore {
            verdict: Verdict::TimedOut,
            ..wrong.clone()
        };
        assert_eq!(clue_in(&timed_out, &whole, &miss), None);
        let with_clue = ItemScore {
            clue: Some("kept".to_owned()),
            ..wrong.clone()
        };
        assert_eq!(clue_in(&with_clue, &whole, &miss), with_clue.clue);
        // A known mistake's hint is more helpful than the clue.
        let mut hinted = wrong;
        hinted.hints = vec![Hint {
            nudge: String::new(),
            hint: String::new(),
        }];
        add_clue(&mut hinted, clue.as_deref());
        assert_eq!(hinted.clue, None);
    }

    #[test]
    fn hints_are_for_wrong_answers_and_for_a_known_reason_why_there_is_none() {
        let all = verdicts();
        let hinted = all.iter().filter(|verdict| can_have_hint(verdict));
        let hinted: Vec<&str> = hinted.map(Verdict::label).collect();
        let expected = "partial, wrong, panicked, out of time, out of memory, crashed";
        assert_eq!(hinted.join(", "), expected);
    }
}
