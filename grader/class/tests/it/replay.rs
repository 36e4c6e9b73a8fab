//! Students who ask about a grade: a question from the exam is run again on the graded files, and
//! the staff's decision stays visible.

use std::fs;

use serde_json::Value;

use crate::harness::{TestClass, assert_contains, refusal, successful_stdout};

const MANUAL: &str = "student,task,delta,comment,author,date\n\
    bob@x.edu,camera,1,the idea is right,Tess,2026-11-30\n\
    ann,camera,0,asked about the offset,Tess,\n";
const ROSTER: &str = "name,username,email\nBob Lee,bob,bob@x.edu\nBob Lee,bo,bo@x.edu\n";

/// Returns a graded class. Bob, who shares his name with another person, has a mistake in
/// `camera.offset`.
fn graded() -> (TestClass, String) {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_offset_mistake("bob")
        .with_folder("bo");
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    class.graded_with(&exam, &[("roster", ROSTER), ("manual-points", MANUAL)], &[]);
    (class, exam)
}

#[test]
fn a_question_is_run_again_as_the_report_quotes_it() {
    let (class, exam) = graded();
    // Only the graded files are used.
    fs::remove_dir_all(class.input()).unwrap();
    let run = |arguments: &[&str]| class.replay(&class.out(), arguments);
    let replay =
        |who: &str, question: &str| successful_stdout(&run(&[who, question, "--exam", &exam]));
    let text = replay("bob", "camera.offset");
    assert_eq!(replay("bob@x.edu", "camera.offset"), text);
    let score: Value = serde_json::from_str(&class.read("students/bob/score.json")).unwrap();
    let evidence = &score["tasks"][0]["items"][0]["evidence"];
    let quoted = ["asked", "got", "wanted"].map(|part| evidence[part].as_str().unwrap());
    assert_contains(&text, &quoted);
    let number = format!("camera.offset#{}", evidence["number"]);
    assert_eq!(replay("bob", &number), text);
    insta::assert_snapshot!([text, replay("ann", "camera.offset")].join("\n"));

    let refused = |arguments: &[&str]| refusal(&run(arguments));
    let errors = [
        refused(&["bobb", "camera.offset", "--exam", &exam]),
        refused(&["Bob Lee", "camera.offset", "--exam", &exam]),
        refused(&["bo", "camera.offset", "--exam", &exam]),
        refused(&["bob", "camera.ofset", "--exam", &exam]),
        refused(&["bob", "camera.offset#0", "--exam", &exam]),
        refused(&["bob", "camera.offset#9999", "--exam", &exam]),
        refused(&["bob", "camera.offset"]),
    ];
    let out = class.out().display().to_string();
    insta::assert_snapshot!("errors", errors.concat().replace(&out, "OUT"));
}

#[test]
fn a_decision_stays_visible_to_staff_and_the_student() {
    let (class, _) = graded();
    let summary: Value = serde_json::from_str(&class.read("class.json")).unwrap();
    insta::assert_snapshot!(serde_json::to_string_pretty(&summary["decisions"]).unwrap());
    for page in ["students/bob/feedback.html", "class.html", "grades.csv"] {
        let decision = "camera: +1 point by Tess, 2026-11-30: the idea is right";
        assert_contains(&class.read(page), &[decision]);
    }
    let page = class.read("students/ann/feedback.html");
    assert_contains(
        &page,
        &["camera: +0 points by Tess: asked about the offset"],
    );
}
