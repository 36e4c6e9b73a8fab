use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use protocol::{Answer, Outcome, Panic};
use sha2::{Digest, Sha256};

use super::Reload;
use crate::exam::Exam;
use crate::exam_file::{self, ExamName};
use crate::exhibit::Exhibits;
use crate::score::{Evidence, FileReport, Hint, Score, Verdict};
use crate::verdict::unasked;

/// All that a submission can say, it says with this.
const HOSTILE: &str =
    "</title></script><script>alert(1)</script>\"><img src=x>&amp;\u{202e}\u{1b}[2J";

fn exam() -> Exam {
    exam_file::load(None).expect("the practice exam").exam
}

fn unjudged(exam: &Exam, submission: &str) -> Score {
    let name = ExamName {
        id: exam.id.clone(),
        hash: "0123456789abcdef".to_owned(),
    };
    unasked(exam, name, submission)
}

/// The page but for its own style and script.
fn page(score: &Score, exam: &Exam, exhibits: &Exhibits) -> String {
    let page = super::page(score, exam, exhibits, Reload::Never);
    page.replace(super::STYLE, "").replace(super::SCRIPT, "")
}

/// With everything passed but the item that `change` is about.
fn all_but(id: &str, change: impl Fn(&mut crate::score::ItemScore)) -> (Exam, Score) {
    let exam = exam();
    let mut score = unjudged(&exam, "alice");
    score.complete = true;
    for item in score.tasks.iter_mut().flat_map(|task| &mut task.items) {
        (item.points, item.verdict) = (item.max_points, Verdict::Pass);
        if item.id == id {
            item.points = 0;
            change(item);
        }
    }
    score.total();
    (exam, score)
}

#[test]
fn nothing_that_a_submission_says_is_more_than_text() {
    let exam = exam();
    let mut score = unjudged(&exam, HOSTILE);
    score.exam.id = HOSTILE.to_owned();
    score.build.notes.push(HOSTILE.to_owned());
    score.build.not_compiled.push(FileReport {
        file: HOSTILE.to_owned(),
        line: None,
        message: HOSTILE.to_owned(),
    });
    let panic = Outcome::Panicked(Panic {
        message: HOSTILE.to_owned(),
        place: HOSTILE.to_owned(),
    });
    let mut exhibits = Exhibits::default();
    for task in &mut score.tasks {
        task.printed = Some(HOSTILE.to_owned());
        for line in &mut task.items {
            line.verdict = Verdict::Panicked;
            line.message = HOSTILE.to_owned();
            line.look = Some(HOSTILE.to_owned());
            line.hints = vec![Hint {
                nudge: HOSTILE.to_owned(),
                hint: HOSTILE.to_owned(),
            }];
            line.evidence = Some(Evidence {
                number: 1,
                asked: HOSTILE.to_owned(),
                got: HOSTILE.to_owned(),
                wanted: HOSTILE.to_owned(),
            });
            let item = exam.items.iter().find(|item| item.id == line.id).unwrap();
            let answers = item
                .questions
                .iter()
                .map(|asked| Answer::Hits(vec![panic.clone(); asked.question.count()]));
            exhibits.keep(item, line, answers.collect());
        }
    }
    let page = page(&score, &exam, &exhibits);
    assert!(page.contains("&lt;script&gt;alert(1)"));
    for bad in ["<script>alert", "<img src=x", "\u{202e}", "\u{1b}"] {
        assert!(!page.contains(bad), "{bad:?}");
    }
    // Ours, and no other.
    assert_eq!(page.matches("<script").count(), 1);
}

#[test]
fn what_is_for_staff_is_not_on_the_page() {
    let (exam, score) = all_but("sphere.normal", |item| {
        item.verdict = Verdict::Wrong;
        item.staff = Some("answers like sphere.inward".to_owned());
    });
    let page = page(&score, &exam, &Exhibits::default());
    assert!(page.contains("sphere.normal") && !page.contains("sphere.inward"));
}

#[test]
fn an_item_without_evidence_has_the_same_three_rows_and_says_why() {
    for (verdict, why) in [
        (Verdict::Unimplemented, "it is not written yet"),
        (Verdict::NotCompiled, "a file that compiles"),
        (Verdict::TimedOut, "no answer: stopped"),
        (
            Verdict::Blocked {
                by: "triangle.inside".to_owned(),
            },
            "triangle.inside first",
        ),
    ] {
        let (exam, score) = all_but("bbox.flat", |item| {
            item.verdict = verdict.clone();
            item.message = "stopped".to_owned();
        });
        let page = page(&score, &exam, &Exhibits::default());
        assert_eq!(page.matches("<table class=\"rows\">").count(), 1);
        for row in ["asked", "got", "wanted"] {
            assert!(
                page.contains(&format!("<th scope=\"row\">{row}</th>")),
                "{row}"
            );
        }
        assert!(page.contains(why), "{why}");
    }
}

#[test]
fn the_first_item_that_fails_is_what_to_do_next() {
    let (exam, score) = all_but("sphere.far_root", |item| item.verdict = Verdict::Wrong);
    let page = page(&score, &exam, &Exhibits::default());
    let next = page.split("What to do next").nth(1).unwrap();
    assert!(
        next.trim_start_matches("</h2><p>")
            .starts_with("<a href=\"#sphere.far_root\">")
    );
    assert!(next.contains("cargo grade --task sphere"));
}

#[test]
fn full_points_in_the_practice_exam_promise_nothing_of_the_final_one() {
    let (exam, score) = all_but("none of them", |_| {});
    let page = page(&score, &exam, &Exhibits::default());
    assert!(page.contains("all that this exam asks is right"));
    assert!(page.contains("with other numbers"));
}

#[test]
fn an_unfinished_page_says_so() {
    let exam = exam();
    let mut score = unjudged(&exam, "alice");
    let is_unfinished =
        |score: &Score| page(score, &exam, &Exhibits::default()).contains("Not finished");
    assert!(is_unfinished(&score));
    score.complete = true;
    assert!(!is_unfinished(&score));
}

#[test]
fn nothing_on_the_page_leads_elsewhere() {
    let (exam, score) = all_but("none of them", |_| {});
    let page = super::page(&score, &exam, &Exhibits::default(), Reload::Never);
    for elsewhere in ["http://", "https://", "url(", "@import", "//cdn"] {
        assert!(!page.contains(elsewhere), "{elsewhere}");
    }
}

#[test]
fn only_a_watched_page_reloads_itself() {
    let (exam, score) = all_but("none of them", |_| {});
    let page = |reload| super::page(&score, &exam, &Exhibits::default(), reload);
    assert!(page(Reload::WhileAway).contains("<body data-reload>"));
    assert!(page(Reload::Never).contains("<body>"));
}

#[test]
fn the_policy_names_the_style_and_the_script_that_the_page_has() {
    let name = |text: &str| format!("sha256-{}", STANDARD.encode(Sha256::digest(text)));
    assert_eq!(
        super::STYLE_NAME,
        name(super::STYLE),
        "of page.css, in mod.rs"
    );
    assert_eq!(
        super::SCRIPT_NAME,
        name(super::SCRIPT),
        "of page.js, in mod.rs"
    );
}
