use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use judging::exam::Exam;
use judging::exam_file::ExamName;
use protocol::{Answer, ElementOutcome, Panic};
use sha2::{Digest, Sha256};

use super::Reload;
use crate::handed_out::RAYS;
use crate::inputs::exam_source::ExamSource;
use crate::report::answers::ReportAnswers;
use crate::score::{Evidence, FileReport, Hint, ItemScore, Score, Verdict};
use crate::verdict::pending_score;

/// Text that attacks the page. The tests use it for every piece of text that a submission can
/// write.
const HOSTILE: &str =
    "</title></script><script>alert(1)</script>\"><img src=x>&amp;\u{202e}\u{1b}[2J";

fn exam() -> Exam {
    ExamSource::Practice
        .load(&RAYS)
        .expect("the practice exam")
        .exam
}

fn sample_pending_score(exam: &Exam, submission: &str) -> Score {
    let name = ExamName {
        id: exam.id.clone(),
        hash: "0123456789abcdef".to_owned(),
    };
    pending_score(exam, name, submission, &RAYS)
}

/// Returns the page without its own style and script.
fn page(score: &Score, exam: &Exam, answers: &ReportAnswers) -> String {
    let page = super::page(score, exam, answers, Reload::Never);
    page.replace(super::STYLE, "").replace(super::SCRIPT, "")
}

/// Returns the page for a submission that passed every item except `id`. `change` adjusts the
/// result of that item.
fn page_of(id: &str, change: impl Fn(&mut ItemScore)) -> String {
    let (exam, score) = all_passed_except(id, change);
    page(&score, &exam, &ReportAnswers::default())
}

/// Returns an exam and its score. Every item passed except `id`. `change` adjusts the result of
/// that item.
fn all_passed_except(id: &str, change: impl Fn(&mut ItemScore)) -> (Exam, Score) {
    let exam = exam();
    let mut score = sample_pending_score(&exam, "alice");
    score.complete = true;
    for item in score.tasks.iter_mut().flat_map(|task| &mut task.items) {
        (item.points, item.verdict) = (item.max_points, Verdict::Pass);
        if item.id == id {
            item.points = 0;
            change(item);
        }
    }
    score.update_totals();
    (exam, score)
}

#[test]
fn escapes_everything_that_a_submission_can_write() {
    let exam = exam();
    let mut score = sample_pending_score(&exam, HOSTILE);
    score.exam.id = HOSTILE.to_owned();
    score.build.notes.push(HOSTILE.to_owned());
    score.build.not_compiled.push(FileReport {
        file: HOSTILE.to_owned(),
        line: None,
        message: HOSTILE.to_owned(),
        is_missing: false,
    });
    let panic = ElementOutcome::Panicked(Panic {
        message: HOSTILE.to_owned(),
        location: HOSTILE.to_owned(),
    });
    let mut answers = ReportAnswers::default();
    for task in &mut score.tasks {
        task.printed = Some(HOSTILE.to_owned());
        for line in &mut task.items {
            line.verdict = Verdict::Panicked;
            line.message = HOSTILE.to_owned();
            line.look = Some(HOSTILE.to_owned());
            let [nudge, hint, asked, got, wanted] = [HOSTILE; 5].map(str::to_owned);
            line.hints = vec![Hint { nudge, hint }];
            line.evidence = Some(Evidence {
                number: 1,
                asked,
                got,
                wanted,
                can_be_shown: true,
            });
            let item = exam.items.iter().find(|item| item.id == line.id).unwrap();
            let panics = item.questions.iter();
            let panics =
                panics.map(|asked| Answer::Hits(vec![panic.clone(); asked.question.count()]));
            answers.record(item, line, panics.collect());
        }
    }
    let page = page(&score, &exam, &answers);
    assert!(page.contains("&lt;script&gt;alert(1)"));
    for bad in ["<script>alert", "<img src=x", "\u{202e}", "\u{1b}"] {
        assert!(!page.contains(bad), "{bad:?}");
    }
    // The only script is the page's own.
    assert_eq!(page.matches("<script").count(), 1);
}

#[test]
fn hides_staff_notes() {
    let page = page_of("sphere.normal", |item| {
        item.verdict = Verdict::Wrong;
        item.staff = Some("the answers match those of sphere.inward".to_owned());
    });
    assert!(page.contains("sphere.normal") && !page.contains("sphere.inward"));
}

#[test]
fn explains_missing_evidence_in_the_same_three_rows() {
    let by = "triangle.inside".to_owned();
    for (verdict, why) in [
        (Verdict::Unimplemented, "the method is not written yet"),
        (Verdict::NotCompiled, "a file that compiles"),
        (Verdict::TimedOut, "no answer: stopped"),
        (Verdict::Blocked { by }, "fix triangle.inside first"),
    ] {
        let page = page_of("bbox.flat", |item| {
            item.verdict = verdict.clone();
            item.message = "stopped".to_owned();
        });
        assert_eq!(page.matches("<table class=\"rows\">").count(), 1);
        let rows = ["asked", "got", "wanted"].map(|row| format!("<th scope=\"row\">{row}</th>"));
        assert!(
            rows.iter().all(|row| page.contains(row)) && page.contains(why),
            "{why}"
        );
    }
}

#[test]
fn suggests_the_first_failing_item() {
    let page = page_of("sphere.far_root", |item| item.verdict = Verdict::Wrong);
    let next = page.split("What to do next").nth(1).unwrap();
    let shown = "</h2><div data-step=\"sphere.far_root\"><p><a href=\"#sphere.far_root\">";
    assert!(next.starts_with(shown));
    assert!(next.contains("cargo grade --task sphere"));
}

#[test]
fn full_practice_points_promise_nothing_about_the_final_exam() {
    let page = page_of("no item", |_| {});
    assert!(page.contains("passes everything that this exam tests"));
    assert!(page.contains("with different numbers"));
}

#[test]
fn an_unfinished_page_says_so() {
    let exam = exam();
    let mut score = sample_pending_score(&exam, "alice");
    let is_unfinished =
        |score: &Score| page(score, &exam, &ReportAnswers::default()).contains("Not finished");
    assert!(is_unfinished(&score));
    score.complete = true;
    assert!(!is_unfinished(&score));
}

#[test]
fn refers_to_no_other_site() {
    let (exam, score) = all_passed_except("no item", |_| {});
    let page = super::page(&score, &exam, &ReportAnswers::default(), Reload::Never);
    for elsewhere in ["http://", "https://", "url(", "@import", "//cdn"] {
        assert!(!page.contains(elsewhere), "{elsewhere}");
    }
}

#[test]
fn the_content_security_policy_has_the_hashes_of_style_and_script() {
    let name = |text: &str| format!("sha256-{}", STANDARD.encode(Sha256::digest(text)));
    let [style, script] = [super::STYLE, super::SCRIPT].map(name);
    assert_eq!(super::STYLE_HASH, style, "of page.css, in mod.rs");
    assert_eq!(super::SCRIPT_HASH, script, "of page.js, in mod.rs");
}
