//! The number of bits that inevitably reach students, because points and verdicts depend on the
//! answers. It is documented in `SECURITY.md`.

use std::fs;
use std::path::Path;

use grader::exam_source::ExamSource;
use grader::format::StudentView;
use grader::handed_out::RAYS;
use grader::policy::Lateness;
use grader::score::{Score, Verdict};
use grader::verdict::pending_score;
use judging::exam::{Exam, Item};
use judging::recognise::MAX_MISTAKES;

use super::policy;

/// The verdicts that earn no points and that a program can choose for an item.
const WITHOUT_POINTS: [Verdict; 7] = [
    Verdict::Wrong,
    Verdict::Panicked,
    Verdict::Unimplemented,
    Verdict::TimedOut,
    Verdict::OutOfMemory,
    Verdict::Crashed,
    Verdict::Protocol,
];

/// Returns the number of results that students can distinguish at a visibility level, not counting
/// hints.
fn distinct_results(score: &Score, item: &Item, level: &str) -> usize {
    let partial = (1..item.points).map(|points| (Verdict::Partial, points));
    let failed = WITHOUT_POINTS.map(|verdict| (verdict, 0));
    let results = [(Verdict::Pass, item.points)].into_iter().chain(failed);
    let mut seen = Vec::new();
    for (verdict, points) in results.chain(partial) {
        let mut score = score.clone();
        let mut items = score.tasks.iter_mut().flat_map(|task| &mut task.items);
        let line = items.find(|line| line.id == item.id).unwrap();
        (line.verdict, line.points) = (verdict, points);
        let view = StudentView::new(&score, &policy(level), Lateness::NONE);
        let view = view.all_items.into_iter();
        let view = view.filter(|entry| entry.visibility.is_shown_now());
        let view: Vec<_> = view.collect();
        if !seen.contains(&view) {
            seen.push(view);
        }
    }
    seen.len()
}

/// Returns the number of sets of hints that an item can have, including the empty one. This is an
/// upper bound, because the hints of a task must agree.
fn sets_of_hints(item: &Item) -> usize {
    let choose = |from: usize, count: usize| {
        (0..count).fold(1, |product, index| product * (from - index) / (index + 1))
    };
    let groups = item.signatures.mistake_answers.iter();
    let sets = groups.map(|answers| {
        let mistakes = answers.mistakes.len();
        let sizes = 1..=MAX_MISTAKES.min(mistakes);
        sizes.map(|size| choose(mistakes, size)).sum::<usize>()
    });
    1 + sets.sum::<usize>()
}

/// Returns the number of bits that an item can send to students at a visibility level.
fn bits_of_item(score: &Score, item: &Item, level: &str) -> f64 {
    let results = distinct_results(score, item, level);
    let results = match level {
        // A passed item has no hints.
        "feedback" => 1 + (results - 1) * sets_of_hints(item),
        _ => results,
    };
    (results as f64).log2()
}

/// Returns the rows of the table in `SECURITY.md`.
fn table(exam: &Exam, score: &Score) -> Vec<String> {
    let mut rows = Vec::new();
    for level in ["feedback", "points"] {
        let items = exam.items.iter();
        let bits: Vec<f64> = items.map(|item| bits_of_item(score, item, level)).collect();
        let most = bits.iter().fold(0.0, |most: f64, bits| most.max(*bits));
        let (sum, mean) = (
            bits.iter().sum::<f64>(),
            bits.iter().sum::<f64>() / bits.len() as f64,
        );
        rows.push(format!("| `{level}` | {mean:.1} | {most:.1} | {sum:.0} |"));
    }
    let tasks = score.tasks.iter();
    let sum: f64 = tasks
        .map(|task| f64::from(task.max_points + 1).log2())
        .sum();
    rows.push(format!("| `hidden` | 0 | 0 | {sum:.0} |"));
    rows
}

#[test]
fn security_md_states_the_bits_that_reach_students() {
    let file = ExamSource::Practice.load(&RAYS).unwrap();
    let mut name = file.name();
    name.id = "final".to_owned();
    let score = pending_score(&file.exam, name, "sender", &RAYS);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("SECURITY.md");
    let text = fs::read_to_string(path).unwrap();
    let mut missing = table(&file.exam, &score);
    missing.retain(|row| !text.contains(row));
    let rows = missing.join("\n");
    assert!(missing.is_empty(), "SECURITY.md does not contain:\n{rows}");
}

#[test]
fn hidden_items_are_not_told_apart() {
    let file = ExamSource::Practice.load(&RAYS).unwrap();
    let score = pending_score(&file.exam, file.name(), "sender", &RAYS);
    for level in ["hidden", "after_due", "after_published"] {
        for item in &file.exam.items {
            assert_eq!(distinct_results(&score, item, level), 1, "{}", item.id);
        }
    }
}
