//! Determines the hints for known mistakes in the reference. A single mistake is graded both with
//! the full exam and with an exam that lacks the mistake's own hint. Pairs of mistakes are graded
//! too.

use std::collections::BTreeSet;
use std::ops::Range;

use anyhow::Result;
use judging::exam::Exam;

use super::{Recognition, answers, hints, list};
use crate::exams;
use crate::hints::with_hints;
use crate::proof::run::{run, run_compiled};
use crate::seed::Seed;
use crate::solutions::Solutions;
use crate::solutions::catalogue::Mistake;
use crate::solutions::solution::Solution;

/// The hints that a known mistake gets with one exam.
struct KnownHints {
    /// The id of the mistake.
    id: String,
    /// The hints with the full exam.
    hints: BTreeSet<String>,
    /// The false hints that the mistake gets when its own hint is removed from the exam.
    if_unknown: BTreeSet<String>,
    /// Whether the exam contains the mistake's signature. It doesn't if only pictures reveal the
    /// mistake, if the mistake produces no answers, or if too many other mistakes produce the same
    /// answers.
    has_signature: bool,
}

/// Runs every known mistake and determines its hints, once with the full exam and once without the
/// mistake's own hint.
pub fn recognise(solutions: &Solutions, exam: &Exam) -> Result<Recognition> {
    Ok(summary(solutions, &known_hints(solutions, exam)?))
}

/// Like [`recognise`], but adds up the results for the final exams that several seeds produce.
pub fn recognise_with_seeds(solutions: &Solutions, seeds: Range<u64>) -> Result<Recognition> {
    let mut all = Vec::new();
    for seed in seeds {
        let exam = exams::generate("final", Seed(seed), solutions)?;
        let found = known_hints(solutions, &with_hints(exam, solutions)?)?;
        eprintln!("seed {seed}: {}", summary(solutions, &found).summary_line);
        all.extend(found);
    }
    Ok(summary(solutions, &all))
}

fn known_hints(solutions: &Solutions, exam: &Exam) -> Result<Vec<KnownHints>> {
    let (workbench, mistakes) = (&solutions.workbench, &solutions.mistakes);
    run(workbench, mistakes, "mistakes", |mistake, built| {
        let answers = answers(mistake, &built, exam)?;
        let mut if_unknown = hints(&answers, &without_hint(solutions, exam, &mistake.id));
        if_unknown.retain(|hint| !solutions.is_hint_true_of(hint, &mistake.id));
        Ok(KnownHints {
            id: mistake.id.clone(),
            hints: hints(&answers, exam),
            if_unknown,
            has_signature: has_signature(exam, &mistake.id),
        })
    })
}

fn has_signature(exam: &Exam, id: &str) -> bool {
    let index = exam.mistakes.iter().position(|mistake| mistake.id == id);
    let signatures = exam.items.iter().map(|item| &item.signatures);
    let mut answers = signatures.flat_map(|signatures| &signatures.mistake_answers);
    index.is_some_and(|index| answers.any(|answers| answers.mistakes.contains(&(index as u32))))
}

/// Returns the exam without the signatures of this mistake and of other mistakes with the same
/// hint.
fn without_hint(solutions: &Solutions, exam: &Exam, id: &str) -> Exam {
    let mut exam = exam.clone();
    let mistakes = exam.mistakes.iter();
    let has_hint: Vec<bool> = mistakes
        .map(|mistake| solutions.have_same_hint(&mistake.id, id))
        .collect();
    let signatures = exam.items.iter_mut().map(|item| &mut item.signatures);
    for answers in signatures.flat_map(|signatures| &mut signatures.mistake_answers) {
        let mistakes = &mut answers.mistakes;
        mistakes.retain(|&mistake| !has_hint[mistake as usize]);
    }
    exam
}

/// Summarises the hints that known mistakes get.
fn summary(solutions: &Solutions, rows: &[KnownHints]) -> Recognition {
    let is_recognised = |row: &&KnownHints| {
        let mut hints = row.hints.iter();
        hints.any(|hint| solutions.have_same_hint(hint, &row.id))
    };
    let (recognised, others): (Vec<_>, Vec<_>) = rows.iter().partition(is_recognised);
    let (others, without_signature): (Vec<_>, Vec<_>) =
        others.into_iter().partition(|row| row.has_signature);
    let with_false_hint = rows.iter().filter(|row| !row.if_unknown.is_empty());
    let (count, false_hint_count) = (
        recognised.len() + others.len(),
        with_false_hint.clone().count(),
    );

    let others = others.into_iter().map(|row| match row.hints.len() {
        0 => format!("{} gets no hint", row.id),
        _ => format!("{} gets the hint {}", row.id, list(&row.hints)),
    });
    let with_false_hint = with_false_hint.map(|row| {
        let hints = list(&row.if_unknown);
        format!(
            "{} gets the false hint {hints} when its own hint is removed",
            row.id
        )
    });
    let unmarked = without_signature.iter();
    let unmarked = unmarked.map(|row| format!("{} has no signature", row.id));
    Recognition {
        count,
        recognised: recognised.len(),
        with_false_hint: false_hint_count,
        problems: Vec::new(),
        lines: others.chain(with_false_hint).chain(unmarked).collect(),
        summary_line: format!(
            "hints: {} of {count} mistakes recognised ({:.0}%), {} more without a signature; \
             when its own hint is removed, a mistake gets a false hint in {false_hint_count} of {} \
             cases",
            recognised.len(),
            100.0 * recognised.len() as f64 / count.max(1) as f64,
            without_signature.len(),
            rows.len(),
        ),
    }
}

/// Runs pairs of mistakes in the same task and determines their hints. If `count` is given, runs
/// only that number of pairs, evenly spread among all of them.
pub fn recognise_pairs(
    solutions: &Solutions,
    exam: &Exam,
    count: Option<usize>,
) -> Result<Recognition> {
    let mistakes = &solutions.catalogue;
    let pairs = mistakes.iter().enumerate().flat_map(|(index, one)| {
        let later = mistakes[index + 1..].iter();
        later
            .filter(|other| other.task() == one.task())
            .map(move |other| (one, other))
    });
    let pairs: Vec<_> = pairs.collect();
    let chosen = count.map_or(pairs.len(), |count| count.clamp(1, pairs.len()));
    let chosen = (0..chosen).map(|index| pairs[index * pairs.len() / chosen]);
    let both: Vec<Option<Solution>> = chosen
        .map(|(one, other)| both_mistakes(solutions, one, other))
        .collect();
    let (workbench, applied) = (&solutions.workbench, both.iter().flatten());
    let rows = run_compiled(workbench, applied, "pairs", |pair, built| {
        let Some(built) = built else {
            return Ok(None);
        };
        let hints = hints(&answers(pair, &built, exam)?, exam).into_iter();
        let [one, other] = [0, 1].map(|index| pair.expected.true_hints[index].as_str());
        let is_true = |hint: &String| solutions.is_hint_true_of_pair(hint, [one, other]);
        let (fits, others): (BTreeSet<String>, _) = hints.partition(is_true);
        Ok(Some((&pair.id, fits, others)))
    })?;

    let compiled: Vec<(&String, BTreeSet<String>, BTreeSet<String>)> =
        rows.into_iter().flatten().collect();
    let with_true_hint = compiled.iter().filter(|(_, fits, _)| !fits.is_empty());
    let with_true_hint = with_true_hint.count();
    let (mut without, mut with_false_hint) = (Vec::new(), Vec::new());
    for (id, fits, others) in &compiled {
        if !others.is_empty() {
            with_false_hint.push(format!("{id} get the false hint {}", list(others)));
        } else if fits.is_empty() {
            without.push(format!("{id} get no hint"));
        }
    }
    Ok(Recognition {
        count: compiled.len(),
        recognised: with_true_hint,
        with_false_hint: with_false_hint.len(),
        problems: Vec::new(),
        summary_line: format!(
            "pairs: {with_true_hint} get a true hint, {} no hint, {} a false one; {} change the same \
             code",
            without.len(),
            with_false_hint.len(),
            both.len() - compiled.len(),
        ),
        lines: [without, with_false_hint].concat(),
    })
}

/// Returns the reference with two mistakes, or `None` if the two cannot be combined.
fn both_mistakes(solutions: &Solutions, one: &Mistake, other: &Mistake) -> Option<Solution> {
    let mut both = one.solution(solutions.recorder.reference()).ok()?;
    both.sources = other.apply(&both.sources).ok()?;
    both.id = format!("{} with {}", one.id, other.id);
    both.expected.true_hints.push(other.id.clone());
    Some(both)
}
