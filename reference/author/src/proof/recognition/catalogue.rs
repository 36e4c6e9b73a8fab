//! Mistakes that the exam doesn't know in this form: known mistakes in the code of variants, and
//! unknown mistakes.

use std::collections::BTreeSet;

use anyhow::Result;
use grader::clue::KEPT_STATE;
use judging::exam::{Exam, Item};
use judging::signatures::ObservedAnswer;

use super::{Recognition, answers, hints, list};
use crate::hints::observed_answers;
use crate::proof::grade::GradedSolution;
use crate::proof::run::run;
use crate::solutions::Solutions;
use crate::solutions::catalogue::{independent_mistakes, other_causes, unknown_mistakes};
use crate::solutions::methods::wrong_methods;
use crate::solutions::solution::Solution;
use crate::solutions::workbench::Answers;

/// The claims that the report makes about a mistake, and whether they are true.
struct ReportedMistake {
    /// The mistake's id, followed by the variant's id if the mistake is in a variant.
    id: String,
    /// The hints in the report that are true of the mistake.
    true_hints: BTreeSet<String>,
    /// The hints in the report that are false.
    false_hints: BTreeSet<String>,
    /// Whether the code really keeps state between calls, if the report says that it does.
    names_state: Option<bool>,
    /// If the mistake gets no true hint, the items where its answers differ from those of the same
    /// mistake in the reference.
    unlike: Vec<String>,
    /// The problems found: the code loses no points in its task, or it loses points in another
    /// task.
    problems: Vec<String>,
}

/// Grades solutions and determines their hints.
fn report(
    solutions: &Solutions,
    mistakes: &[Solution],
    exam: &Exam,
) -> Result<Vec<ReportedMistake>> {
    let workbench = &solutions.workbench;
    run(workbench, mistakes, "mistakes", |mistake, built| {
        let graded = GradedSolution::new(mistake, &built, exam)?;
        let mut clues = graded.score.items().filter_map(|item| item.clue.as_deref());
        let names_state = clues.any(|clue| clue == KEPT_STATE);
        let made = &mistake.expected.true_hints;
        let is_true = |hint: &String| {
            let mut made = made.iter();
            made.any(|made| solutions.is_hint_true_of(hint, made))
        };
        let answers = answers(mistake, &built, exam)?;
        let hints = hints(&answers, exam).into_iter();
        let (true_hints, false_hints): (BTreeSet<String>, _) = hints.partition(is_true);
        let unlike = match made.first() {
            Some(known) if true_hints.is_empty() => items_unlike_signature(exam, known, &answers),
            _ => Vec::new(),
        };
        Ok(ReportedMistake {
            id: mistake.id.clone(),
            true_hints,
            false_hints,
            names_state: names_state.then_some(mistake.expected.keeps_state),
            unlike,
            problems: graded.task_problems(),
        })
    })
}

/// Grades every independent mistake, and every solution that gives the same answers as a known
/// mistake, but for a different reason. Determines the hints that they get.
pub fn recognise_independent(solutions: &Solutions, exam: &Exam) -> Result<Recognition> {
    let all = [independent_mistakes(solutions)?, other_causes(solutions)?].concat();
    let rows = report(solutions, &all, exam)?;
    let mut recognition = Recognition {
        count: rows.len(),
        ..Recognition::default()
    };
    for row in rows {
        let id = row.id;
        let is_named = !row.true_hints.is_empty() || row.names_state == Some(true);
        recognition.lines.push(if !row.false_hints.is_empty() {
            recognition.with_false_hint += 1;
            format!("{id}: false hint {}", list(&row.false_hints))
        } else if row.names_state == Some(false) {
            recognition.with_false_hint += 1;
            format!("{id}: falsely reported as keeping state")
        } else if is_named {
            recognition.recognised += 1;
            format!("{id}: recognised")
        } else {
            let unlike = row.unlike.join(", ");
            format!(
                "{id}: no hint; compared with the same mistake in the reference, its answers \
                 differ in: {unlike}"
            )
        });
        recognition.problems.extend(row.problems);
    }
    let (count, with_false_hint) = (recognition.count, recognition.with_false_hint);
    let recognised = recognition.recognised;
    recognition.summary_line = format!(
        "mistakes in other solutions: {recognised} of {count} recognised ({:.0}%), {} get no hint, \
         {with_false_hint} a false one",
        100.0 * recognised as f64 / count.max(1) as f64,
        count - recognised - with_false_hint,
    );
    Ok(recognition)
}

/// Grades one in `step` unknown mistakes and determines the hints that they get.
pub fn recognise_unknown(solutions: &Solutions, exam: &Exam, step: usize) -> Result<Recognition> {
    let all = [unknown_mistakes(solutions)?, wrong_methods(solutions)?].concat();
    let all: Vec<Solution> = all.into_iter().step_by(step).collect();
    let rows = report(solutions, &all, exam)?;
    let with_false_hint = rows.iter().filter(|row| !row.false_hints.is_empty());
    let lines: Vec<String> = with_false_hint
        .map(|row| format!("{}: false hint {}", row.id, list(&row.false_hints)))
        .collect();
    let hinted = rows.iter().filter(|row| !row.true_hints.is_empty());
    Ok(Recognition {
        count: rows.len(),
        recognised: hinted.count(),
        with_false_hint: lines.len(),
        summary_line: format!(
            "unknown mistakes: {}, of which {} get a false hint",
            rows.len(),
            lines.len()
        ),
        lines,
        problems: rows.into_iter().flat_map(|row| row.problems).collect(),
    })
}

/// Returns the items where a solution's answers differ from those the exam has recorded for a known
/// mistake, each with the number of answers that differ.
fn items_unlike_signature(exam: &Exam, mistake: &str, answers: &[(&Item, Answers)]) -> Vec<String> {
    let mut known = exam.mistakes.iter();
    let index = known.position(|known| known.id == mistake);
    let unlike = answers.iter().filter_map(|(item, answers)| {
        let recorded = recorded_answers(item, index);
        let got = observed_answers(item, answers);
        let elements = item.signatures.elements.iter().zip(&recorded);
        let differing = elements.filter(|(element, recorded)| {
            let got = got.get(**element as usize);
            !got.is_some_and(|got| got.matches(recorded))
        });
        let (count, of) = (differing.count(), recorded.len());
        (count > 0).then(|| format!("{} ({count} of {of})", item.id))
    });
    unlike.collect()
}

/// Returns the answers that the exam has recorded for a mistake: one for each element that is part
/// of the item's signatures.
fn recorded_answers(item: &Item, mistake: Option<usize>) -> Vec<ObservedAnswer> {
    let signatures = &item.signatures;
    let mut answers = signatures.correct_answers.clone();
    let mut all = signatures.mistake_answers.iter();
    let own = all.find(|answers| {
        let mut mistakes = answers.mistakes.iter();
        mistakes.any(|&index| Some(index as usize) == mistake)
    });
    for (element, wrong) in own.iter().flat_map(|own| &own.answers) {
        if let Some(answer) = answers.get_mut(*element as usize) {
            answer.clone_from(wrong);
        }
    }
    answers
}
