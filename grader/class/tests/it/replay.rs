//! Students who ask about a grade: a question from the exam is run again on the graded files, and
//! the staff's decision stays visible.

use std::fs;

use grader::handed_out::RAYS;
use serde_json::Value;

use crate::harness::{
    TestClass, assert_contains, cell, refusal, solution, source, successful_stdout, table,
};

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

/// Each name stands for the attempt that counts. Blackboard's attempts don't have folders.
#[test]
fn a_person_with_several_attempts_is_found_by_the_one_that_counts() {
    let attempt = |class: TestClass, day: u32, from: &str| {
        let name = format!("CG26_ann_attempt_2026-11-{day}-10-00-00");
        let class = class.with(&format!("{name}.txt"), "Name: Ann Lee (ann)\n");
        RAYS.file_names().fold(class, |class, file| {
            let text = source(&format!("{from}/{file}"));
            class.with(&format!("{name}_{file}"), text)
        })
    };
    let class = attempt(TestClass::named("class"), 19, "grader/starter");
    let class = attempt(class, 21, "grader/starter");
    let class = attempt(class, 20, "reference/src");
    let exam = class.small_exam(&["camera.offset"]);
    let roster = "name,username,email\nAnn Lee,ann,ann@x.edu\n";
    let graded = |rule: &str, more: &[&str]| {
        let policy = format!("[late]\ntimezone = 'UTC'\n[attempts]\ncounts = '{rule}'\n");
        class.graded_with(&exam, &[("roster", roster), ("policy", &policy)], more)
    };
    let replay = |who: &str| class.replay(&class.out(), &[who, "camera.offset", "--exam", &exam]);
    graded("ask", &[]);
    let ids = table(&class.read("grades.csv")).into_iter();
    let ids = Vec::from_iter(ids.map(|row| row["submission"].clone()));
    let error = refusal(&replay("ann@x.edu"));
    let expected = format!("could be {}: use one of these names", ids.join(" or "));
    assert_contains(&error, &[expected]);
    for (rule, id) in [("best", &ids[1]), ("latest", &ids[2])] {
        graded(rule, &[]);
        for who in ["ann@x.edu", "Ann Lee"] {
            let title = format!("{id} (Ann Lee)\n");
            assert_contains(&successful_stdout(&replay(who)), &[title]);
        }
    }
    let again = class.path_beside("again");
    fs::create_dir(&again).unwrap();
    fs::write(again.join("Ann Lee.zip"), solution()).unwrap();
    for _ in 0..2 {
        graded("latest", &["--corrected", again.to_str().unwrap()]);
        assert_eq!(cell(&class, &ids[2], "Ann Lee", "counts"), "2");
    }
}
