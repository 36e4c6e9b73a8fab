//! Well-formed answers with arbitrary values, which are judged, compared with known mistakes,
//! scored and written to all three reports.

use std::sync::LazyLock;

use grader::handed_out::RAYS;
use grader::item_outcome::ItemOutcome;
use grader::report::html::{Reload, page};
use grader::report::text::{HintDetail, report};
use grader::report_answers::ReportAnswers;
use grader::score::Verdict;
use grader::task_selection::TaskSelection;
use grader::verdict::{add_hints, item_score, pending_score};
use judging::exam::{Exam, ExamQuestion, Item};
use judging::exam_file::ExamFile;
use judging::judge::{judge, measure, mismatches};
use judging::recognise::Observations;
use protocol::Answer;

/// An exam with an item for each kind of answer key.
static EXAM: LazyLock<ExamFile> = LazyLock::new(|| {
    let text = include_bytes!("small.json");
    judging::exam_file::parse("small.json".as_ref(), text, RAYS.assignment)
        .expect("the exam is valid")
});

/// Grades the bytes: the first byte chooses the item, and the answers to the item's questions
/// follow.
pub fn read(bytes: &[u8]) {
    let Some((choice, mut rest)) = bytes.split_first() else {
        return;
    };
    let items = &EXAM.exam.items;
    let item = &items[usize::from(*choice) % items.len()];
    let mut answers = Vec::new();
    for _ in &item.questions {
        let Ok((answer, left)) = postcard::take_from_bytes::<Answer>(rest) else {
            return;
        };
        answers.push(answer);
        rest = left;
    }
    grade(item, answers);
}

fn grade(item: &Item, answers: Vec<Answer>) {
    let exam = Exam {
        items: vec![item.clone()],
        ..EXAM.exam.clone()
    };
    let judgements: Vec<_> = answered_questions(item, &answers)
        .map(|(question, answer)| judge(question, answer))
        .collect();
    for (question, answer) in answered_questions(item, &answers) {
        let _ = (measure(question, answer), mismatches(question, answer));
    }
    let mut scored = item_score(item, &ItemOutcome::answered(judgements), &RAYS);
    let is_right = scored.points == scored.max_points;
    assert_eq!(is_right, scored.verdict == Verdict::Pass, "{scored:?}");

    let mut observations = Observations::default();
    observations.record(item, Ok(&answers));
    add_hints(&mut scored, &observations.explain(&exam, item));
    let mut report_answers = ReportAnswers::default();
    report_answers.record(item, &scored, answers);
    let mut score = pending_score(&exam, EXAM.name(), "any", &RAYS);
    score.record(scored);
    score.update_totals();
    score.complete = true;

    let text = score.to_json();
    serde_json::from_str::<serde_json::Value>(&text).expect("the score is JSON");
    let printed = report(&score, &TaskSelection::All, HintDetail::Full);
    assert!(
        !printed.contains('\u{7}'),
        "the report has a bell character"
    );
    let page = page(&score, &exam, &report_answers, Reload::Never);
    assert!(page.ends_with("</html>"), "the page is complete");
}

fn answered_questions<'a>(
    item: &'a Item,
    answers: &'a [Answer],
) -> impl Iterator<Item = (&'a ExamQuestion, &'a Answer)> {
    item.questions.iter().zip(answers)
}
