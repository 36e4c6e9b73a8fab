//! Answers that are well formed and otherwise anything: judged, recognised, scored, and put into
//! all three reports.

use std::sync::LazyLock;

use grader::exam::{Asked, Exam, Item};
use grader::exam_file::ExamFile;
use grader::exhibit::Exhibits;
use grader::judge::{blemishes, judge, measure};
use grader::recognise::Sightings;
use grader::report::html::{Reload, page};
use grader::report::json;
use grader::report::text::{Hints, report};
use grader::score::Verdict;
use grader::verdict::{Outcome, hinted, item_score, unasked};
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
    let judgements: Vec<_> = asked(item, &answers).map(|(a, b)| judge(a, b)).collect();
    for (asked, answer) in asked(item, &answers) {
        let _ = (measure(asked, answer), blemishes(asked, answer));
    }
    let mut line = item_score(item, &Outcome::Answered(judgements));
    let is_right = line.points == line.max_points;
    assert_eq!(is_right, line.verdict == Verdict::Pass, "{line:?}");

    let mut sightings = Sightings::default();
    sightings.note(item, Ok(&answers));
    hinted(&mut line, &sightings.explain(&exam, item));
    let mut exhibits = Exhibits::default();
    exhibits.keep(item, &line, answers);
    let mut score = unasked(&exam, EXAM.name(), "any");
    score.record(line);
    score.total();
    score.complete = true;

    let text = json::text(&score);
    serde_json::from_str::<serde_json::Value>(&text).expect("the score is JSON");
    let shown = report(&score, None, Hints::Full);
    assert!(!shown.contains('\u{7}'), "a bell rings");
    let page = page(&score, &exam, &exhibits, Reload::Never);
    assert!(page.ends_with("</html>"), "the page is whole");
}

fn asked<'a>(
    item: &'a Item,
    answers: &'a [Answer],
) -> impl Iterator<Item = (&'a Asked, &'a Answer)> {
    item.questions.iter().zip(answers)
}
