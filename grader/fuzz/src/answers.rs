//! Answers that are well formed and otherwise anything: judged, recognised, scored, and put into
//! all three reports.

use std::sync::LazyLock;

use grader::exam::{Exam, ExamQuestion, Item};
use grader::exam_file::ExamFile;
use grader::judge::{judge, measure, mismatches};
use grader::recognise::Observations;
use grader::report::html::{Reload, page};
use grader::report::json;
use grader::report::text::{HintDetail, report};
use grader::report_answers::ReportAnswers;
use grader::score::Verdict;
use grader::verdict::{ItemOutcome, add_hints, item_score, pending_score};
use protocol::Answer;

/// An item of each kind of key.
static EXAM: LazyLock<ExamFile> = LazyLock::new(|| {
    let text = include_bytes!("small.json");
    grader::exam_file::parse("small.json".as_ref(), text).expect("it is a good exam")
});

/// The first byte chooses the item; the answers to its questions follow.
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
        .map(|(a, b)| judge(a, b))
        .collect();
    for (asked, answer) in answered_questions(item, &answers) {
        let _ = (measure(asked, answer), mismatches(asked, answer));
    }
    let mut line = item_score(item, &ItemOutcome::Answered(judgements));
    let is_right = line.points == line.max_points;
    assert_eq!(is_right, line.verdict == Verdict::Pass, "{line:?}");

    let mut sightings = Observations::default();
    sightings.record(item, Ok(&answers));
    add_hints(&mut line, &sightings.explain(&exam, item));
    let mut exhibits = ReportAnswers::default();
    exhibits.record(item, &line, answers);
    let mut score = pending_score(&exam, EXAM.name(), "any");
    score.record(line);
    score.update_totals();
    score.complete = true;

    let text = json::to_string(&score);
    serde_json::from_str::<serde_json::Value>(&text).expect("the score is JSON");
    let shown = report(&score, None, HintDetail::Full);
    assert!(!shown.contains('\u{7}'), "a bell rings");
    let page = page(&score, &exam, &exhibits, Reload::Never);
    assert!(page.ends_with("</html>"), "the page is whole");
}

fn answered_questions<'a>(
    item: &'a Item,
    answers: &'a [Answer],
) -> impl Iterator<Item = (&'a ExamQuestion, &'a Answer)> {
    item.questions.iter().zip(answers)
}
