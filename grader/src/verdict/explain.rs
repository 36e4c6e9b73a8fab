//! Explains a task's wrong answers with known mistakes or with clues for the whole task. The
//! functions here are pure.

use judging::assignment::{TaskClues, TaskInfo};
use judging::exam::{Exam, Item};
use judging::recognise::Observations;
use judging::section::Section;
use judging::symptom::{Side, Symptom};

use crate::handed_out::HandedOut;
use crate::score::{ItemScore, Verdict, VerdictKind};
use crate::verdict::sections::chapter;
use crate::verdict::{add_hints, clue};

/// Adds the hints for the mistakes that explain a task's answers, which come from the submission's
/// own program or from the program with substituted parts. If no mistake explains the answers, adds
/// a clue, either for code whose rays never hit anything or for the quantity that is wrong.
pub fn explain_items(
    exam: &Exam,
    lines: &mut [ItemScore],
    own: &Observations,
    substituted: Option<&Observations>,
    handed_out: &HandedOut,
) {
    let mut first_missed = None;
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
                add_clue_on_misses(line, &info.clues, &mut first_missed);
            }
        }
    }
    for index in 0..lines.len() {
        let (earlier, rest) = lines.split_at_mut(index);
        if let Some(item) = exam.items.iter().find(|item| item.id == rest[0].id) {
            add_symptom_clue(item, &mut rest[0], earlier, handed_out);
        }
    }
}

/// Adds the clue for code whose rays never hit anything, unless a hint or another clue is more
/// helpful. Only the first item gets the clue, and the others name that item.
fn add_clue_on_misses(line: &mut ItemScore, clues: &TaskClues, first: &mut Option<String>) {
    let Some(clue) = clues.if_nothing_is_hit.filter(|_| line.has_no_clue()) else {
        return;
    };
    match first {
        Some(first) => line.symptom_clue = Some(fix_first(first)),
        None => {
            line.clue = Some(for_every_ray(clue));
            *first = Some(line.id.clone());
        }
    }
    let of_miss = clues.of_symptom(&Symptom::MISS);
    line.clue_section = of_miss.map(|clue| Section::new(clue.section));
}

/// Returns the whole clue for code whose rays never hit anything.
fn for_every_ray(clue: &str) -> String {
    format!(
        "Your code returns a miss for every ray, so look for something that is wrong for all of \
         them. {clue}"
    )
}

/// Returns the advice for an item that fails in the same way as an earlier item.
fn fix_first(earlier: &str) -> String {
    format!("{earlier} fails in the same way: fix that first.")
}

/// Returns whether the `earlier` item has less than half the item's share of wrong answers. Then the
/// mistake has more to do with the item's own idea than with that of the earlier item.
fn is_much_rarer(earlier: &ItemScore, item: &ItemScore) -> bool {
    let share = |item: &ItemScore| match item.wrong_answers {
        Some((wrong, all)) => wrong as f64 / all as f64,
        None => 1.0,
    };
    share(earlier) < 0.5 * share(item)
}

/// Adds the clue for the quantity that is wrong in an item, unless the item is explained already or
/// its own advice is about that quantity. If an `earlier` item of the task fails in the same way,
/// and not much more rarely, the clue says to fix that item first.
fn add_symptom_clue(
    item: &Item,
    line: &mut ItemScore,
    earlier: &[ItemScore],
    handed_out: &HandedOut,
) {
    let Some(symptom) = &line.symptom else {
        // If a task fails from its first item on, its failures say nothing about the idea behind
        // this item.
        let is_unexplained = line.verdict.kind() == VerdictKind::NoAnswer
            && line.hints.is_empty()
            && line.section == item.section
            && line.clue_section.is_none();
        if is_unexplained && earlier.iter().all(|other| other.verdict != Verdict::Pass) {
            line.clue_section = chapter(item, handed_out);
        }
        return;
    };
    let is_alike = |other: &&ItemScore| {
        other.symptom.as_ref() == Some(symptom)
            && other.verdict.kind() == VerdictKind::Failed
            && !is_much_rarer(other, line)
    };
    if line.clue_section.is_some() {
        // The item has a clue with a section of its own.
        return;
    }
    let of_symptom = clue_on_symptom(item, symptom, handed_out);
    let first = earlier.iter().find(is_alike).filter(|_| line.has_no_clue());
    line.symptom_clue = match first {
        Some(first) => Some(fix_first(&first.id)),
        None => of_symptom.as_ref().map(|(clue, _)| (*clue).to_owned()),
    };
    line.clue_section = match first {
        Some(first) => first.where_to_read().cloned(),
        // A recognised mistake has its own section, which may be the item's.
        None if !line.hints.is_empty() || line.section != item.section => None,
        None => of_symptom.and_then(|(_, section)| section),
    };
}

/// Returns the clue for an item with this symptom and the section to read, unless the item's own
/// advice is about that symptom.
fn clue_on_symptom(
    item: &Item,
    symptom: &Symptom,
    handed_out: &HandedOut,
) -> Option<(&'static str, Option<Section>)> {
    let clues = &handed_out.assignment.info(item.task).clues;
    let clue = clues.of_symptom(symptom);
    // A clue about zero says more than an item's advice about every symptom.
    let says_more = symptom.is_about_zero()
        && item.look_fits.is_empty()
        && clue.is_some_and(|clue| clue.symptoms.contains(symptom));
    if item.has_look_for(symptom) && !says_more {
        return None;
    }
    if symptom.side == Some(Side::NotANumber) {
        return Some((clue::NOT_A_NUMBER, chapter(item, handed_out)));
    }
    let clue = clue?;
    Some((clue.clue, Some(Section::new(clue.section))))
}

/// Returns whether these are all the items of a task. After a save, the items that failed before
/// are graded first. Until the other items are graded, their rays might still hit something.
fn is_whole_task<'a>(items: impl Iterator<Item = &'a Item>, info: &TaskInfo) -> bool {
    items.map(|item| item.points).sum::<u32>() == info.points
}

/// Returns whether a hint is possible, i.e. whether there is a wrong answer or a known reason for a
/// missing answer.
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
        // Returns the clue in an item's score after all items were answered with two misses and
        // `last`.
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
        let clue = bbox.clues.if_nothing_is_hit.map(for_every_ray);
        assert!(clue.is_some());
        assert_eq!(clue_in(&wrong, &whole, &miss), clue);
        assert_eq!(clue_in(&wrong, &whole, &hit), None);
        // A question that isn't asked could have been answered with a hit.
        let mut some = whole.clone();
        some.items.pop();
        assert_eq!(clue_in(&wrong, &some, &miss), None);

        // The section fits the clue, and later items name the first one instead of repeating it.
        let mut lines = ["bbox.flat", "bbox.behind"].map(|id| ItemScore {
            id: id.to_owned(),
            ..wrong.clone()
        });
        let mut first = None;
        for line in &mut lines {
            add_clue_on_misses(line, &bbox.clues, &mut first);
        }
        let section = bbox.clues.of_symptom(&Symptom::MISS).unwrap().section;
        for line in &lines {
            assert_eq!(line.where_to_read(), Some(&Section::new(section)));
        }
        let second = lines[1].where_to_look().map(String::as_str);
        let expected = "bbox.flat fails in the same way: fix that first.";
        assert_eq!((&lines[0].clue, second), (&clue, Some(expected)));

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
        add_clue_on_misses(&mut hinted, &bbox.clues, &mut None);
        assert_eq!(hinted.clue, None);
    }

    #[test]
    fn the_clue_fits_what_is_wrong_and_an_earlier_item_that_fails_alike_comes_first() {
        let mut exam = exam(&[
            "sphere.near_side",
            "sphere.uv",
            "sphere.normal",
            "sphere.radius",
        ]);
        exam.items[1].look_fits = vec![Symptom::of("uv")];
        exam.items[2].look_fits = vec![Symptom::of("normal")];
        let wrong = |symptoms: [Symptom; 4]| {
            let mut lines: Vec<ItemScore> = pending(&exam).items().cloned().collect();
            for (line, symptom) in lines.iter_mut().zip(symptoms) {
                line.verdict = Verdict::Wrong;
                line.symptom = Some(symptom);
                line.section = exam.items[0].section.clone();
            }
            explain_items(&exam, &mut lines, &Observations::default(), None, &RAYS);
            lines
        };
        let lines = wrong([
            Symptom::HIT,
            Symptom::MISS,
            Symptom::MISS,
            Symptom::of("uv"),
        ]);
        let sphere = &RAYS.assignment.find("sphere").unwrap().clues;
        let miss = sphere.of_symptom(&Symptom::MISS).unwrap();
        // The first item's own advice covers every symptom.
        assert_eq!(
            (&lines[0].symptom_clue, &lines[0].clue_section),
            (&None, &None)
        );
        assert_eq!(lines[1].symptom_clue.as_deref(), Some(miss.clue));
        assert_eq!(lines[1].clue_section, Some(Section::new(miss.section)));
        let first = "sphere.uv fails in the same way: fix that first.";
        assert_eq!(lines[2].symptom_clue.as_deref(), Some(first));
        assert_eq!(lines[2].clue_section, lines[1].clue_section);
        assert_eq!(lines[3].symptom_clue, None);
        // The second item's own advice covers its symptom. The third item fails in a different way
        // from the first, so it has its own clue.
        let lines = wrong([
            Symptom::MISS,
            Symptom::of("uv"),
            Symptom::HIT,
            Symptom::MISS,
        ]);
        assert_eq!(lines[1].symptom_clue, None);
        let hit = sphere.of_symptom(&Symptom::HIT).unwrap();
        assert_eq!(lines[2].symptom_clue.as_deref(), Some(hit.clue));
        let first = "sphere.near_side fails in the same way: fix that first.";
        assert_eq!(lines[3].symptom_clue.as_deref(), Some(first));
        // An earlier item that fails much more rarely isn't named.
        let with_rare = |wrong| {
            let mut lines: Vec<ItemScore> = pending(&exam).items().cloned().collect();
            for line in &mut lines {
                line.verdict = Verdict::Wrong;
                line.symptom = Some(Symptom::MISS);
                line.wrong_answers = Some((40, 80));
            }
            lines[0].wrong_answers = Some((wrong, 100));
            explain_items(&exam, &mut lines, &Observations::default(), None, &RAYS);
            lines.into_iter().map(|line| line.symptom_clue).nth(1)
        };
        let named = [10, 25].map(|wrong| with_rare(wrong).flatten().as_deref() == Some(first));
        assert_eq!(named, [false, true]);
        // No item's own advice is about NaN.
        let nan = |what| Symptom {
            side: Some(Side::NotANumber),
            ..Symptom::of(what)
        };
        let lines = wrong([nan("distance"), nan("uv"), nan("normal"), Symptom::MISS]);
        for line in &lines[..3] {
            assert_eq!(line.symptom_clue.as_deref(), Some(clue::NOT_A_NUMBER));
            assert_eq!(line.clue_section, Some(Section::new("sphere.md")));
        }
    }

    #[test]
    fn if_every_item_fails_without_an_answer_the_chapter_is_to_be_read() {
        let exam = exam(&["sphere.near_side", "sphere.radius"]);
        let section_of_second = |first: Verdict| {
            let mut lines: Vec<ItemScore> = pending(&exam).items().cloned().collect();
            let verdicts = [first, Verdict::Crashed];
            for ((line, item), verdict) in lines.iter_mut().zip(&exam.items).zip(verdicts) {
                line.verdict = verdict;
                line.section = item.section.clone();
            }
            explain_items(&exam, &mut lines, &Observations::default(), None, &RAYS);
            lines[1].where_to_read().cloned()
        };
        let own = exam.items[1].section.clone();
        assert_eq!(section_of_second(Verdict::Pass), own);
        // The section is in a different chapter, like those of the items with pictures.
        assert_eq!(own, Some(Section::new("boxes.md#a-heading")));
        let chapter = Some(Section::new("sphere.md"));
        assert_eq!(section_of_second(Verdict::Crashed), chapter);
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
