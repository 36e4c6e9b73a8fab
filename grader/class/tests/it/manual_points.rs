//! The table of manual points: who its rows belong to, what effect they have, and what can be wrong
//! with them.

use serde_json::Value;

use crate::harness::{TestClass, cell, refusal, successful_stdout};

const HEADER: &str = "author,student,task,comment,delta";

/// Creates a class where two people are called Ann Lee. One of them handed in the reference, which
/// gets 2 of 2 points for the camera.
fn class() -> (TestClass, String) {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_starter("ann2")
        .with_folder("bob");
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    (class, exam)
}

const ROSTER: &str = "name,username,email\n\
    Ann Lee,ann,ann@x.edu\nAnn Lee,ann2,ann2@x.edu\nBob Kim,bob,bob@x.edu\n\
    Zoe Lim,zoe,zoe@x.edu\n";

#[test]
fn a_row_is_found_by_any_identifier_and_stays_in_the_range_of_its_task() {
    let (class, exam) = class();
    // The columns may be in any order, and cells may have spaces around them.
    let rows = [
        HEADER,
        "Kim,ANN@x.edu ,camera,nice, -1",
        "Kim,ann2,camera,,2",
        "Kim,bob kim,camera,on paper,1",
        "Kim,bob,sphere,,1",
    ];
    let manual = format!("{}\n", rows.join("\n"));
    class.graded_with(
        &exam,
        &[("roster", ROSTER), ("manual-points", &manual)],
        &[],
    );
    let row = |id: &str, name: &str| {
        let cells = ["counts", "manual", "comments"].map(|column| cell(&class, id, name, column));
        format!("{id}: {}", cells.join(" | "))
    };
    let rows = [
        row("ann", "Ann Lee"),
        row("ann2", "Ann Lee"),
        row("bob", "Bob Kim"),
    ];
    insta::assert_snapshot!(rows.join("\n"), @r"
    ann: 2 | -1 | camera: -1 point by Kim: nice
    ann2: 2 | 2 | camera: +2 points by Kim
    bob: 2 | 2 | camera: +1 point by Kim: on paper; sphere: +1 point by Kim
    ");
}

#[test]
fn a_row_that_cannot_be_used_is_an_error_with_its_number() {
    let (class, exam) = class();
    class.graded_with(&exam, &[("roster", ROSTER)], &[]);
    let refused = |text: &str| {
        let path = class.write_beside("manual.csv", &format!("{text}\n"));
        let error = class.refused(&exam, &["--manual-points", &path]);
        let (_, error) = error.rsplit_once("error: ").unwrap();
        error.replace(&path, "manual.csv")
    };
    let rows = [
        "Kim,ann,cameras,,1",
        "Kim,,sphere,,1",
        ",ann,sphere,,1",
        "Kim,ann,sphere,,1.5",
        "Kim,eve,sphere,,1",
        "Kim,zoe,sphere,,1",
        "Kim,Ann Lee,sphere,,1",
        "Kim,bob,camera,,1",
        "Kim,ann,camera,,1",
        "Kim,ann,camera,,-3",
        "Kim,ann,build,,1",
    ];
    let errors = rows.map(|row| refused(&format!("{HEADER}\nKim,bob@x.edu,camera,,1\n{row}")));
    let no_author = refused("student,task,delta,comment");
    insta::assert_snapshot!(errors.concat() + &no_author);
    // Whether points are in range is only known after grading. The earlier table still counts.
    let accepted = format!("{HEADER}\nKim,bob@x.edu,camera,,1\n");
    class.graded_with(&exam, &[("manual-points", &accepted)], &[]);
    refused(&format!("{HEADER}\nKim,ann,camera,,-3"));
    class.graded(&exam, &[]);
    assert_eq!(cell(&class, "bob", "Bob Kim", "manual"), "1");
}

/// Ann and Bob are a team, and there are two people called Ann Lee. Cem has two submissions.
#[test]
fn a_row_may_name_a_team_or_a_submission_as_the_lists_and_pages_do() {
    let class = TestClass::named("class")
        .with_reference("Night Owls")
        .with_reference("ann2")
        .with_reference("cem")
        .with_starter("u4");
    let exam = class.small_exam(&["camera.offset"]);
    let roster = "name,username,sid,email,group\n\
        Ann Lee,ann,u1,ann@x.edu,Night_Owls\nBob Kim,bob,u2,,Night_Owls\n\
        Ann Lee,ann2,u3,ann2@x.edu,A-Team\nCem Kaya,cem,u4,,Ateam\n";
    let policy = "[attempts]\ncounts = \"best\"\n";
    class.graded_with(&exam, &[("roster", roster), ("policy", policy)], &[]);
    let grade = |student: &str| {
        let rows = format!("{HEADER}\nKim,{student},camera,,-1\n");
        let path = class.write_beside("manual.csv", &rows);
        class.grade(&exam, &["--manual-points", &path])
    };
    let people = [
        ("Night_Owls", "Ann Lee"),
        ("Night_Owls", "Bob Kim"),
        ("ann2", "Ann Lee"),
        ("cem", "Cem Kaya"),
    ];
    let counts = |student: &str| {
        successful_stdout(&grade(student));
        people.map(|(id, name)| cell(&class, id, name, "counts"))
    };
    for (student, expected) in [
        ("Night Owls", "1122"),
        ("night_owls", "1122"),
        ("Ann Lee + Bob Kim", "1122"),
        ("BobKim", "2122"),
        ("Ann Lee (ann2@x.edu)", "2212"),
        ("cem", "2221"),
    ] {
        assert_eq!(counts(student).concat(), expected, "{student}");
    }
    let errors = ["A Team", "Ann Lee", "bob@tum.edu", "carl", "cem + ann2"];
    let errors = errors.map(|student| {
        let error = refusal(&grade(student));
        error.rsplit_once(", row ").unwrap().1.to_owned()
    });
    insta::assert_snapshot!(errors.concat(), @r#"
    2: "A Team" could be Ann Lee (ann2@x.edu) or Cem Kaya: use the email address or the student number
    2: "Ann Lee" could be Ann Lee (ann@x.edu) or Ann Lee (ann2@x.edu): use the email address or the student number
    2: nobody called "bob@tum.edu" handed anything in (did you mean bob?): use a name, email address, account or student id from grades.csv, or the name of a group or submission
    2: nobody called "carl" handed anything in: use a name, email address, account or student id from grades.csv, or the name of a group or submission
    2: nobody called "cem + ann2" handed anything in: use a name, email address, account or student id from grades.csv, or the name of a group or submission
    "#);
}

#[test]
fn a_row_that_names_a_submission_is_for_no_other_attempt() {
    let version = |number: u32| format!("Submitted files/Ann Lee/Path tracer/Version {number}");
    let class = TestClass::named("library")
        .with_starter(&version(1))
        .with_reference(&version(2));
    let exam = class.small_exam(&["camera.offset"]);
    let policy = class.write_beside("policy.toml", "[attempts]\ncounts = 'latest'\n");
    for (student, expected) in [("Ann_Lee_1", "2"), ("Ann_Lee_2", "1"), ("Ann Lee", "1")] {
        let rows = format!("{HEADER}\nKim,{student},camera,,-1\n");
        let path = class.write_beside("manual.csv", &rows);
        let output = class.grade(&exam, &["--policy", &policy, "--manual-points", &path]);
        successful_stdout(&output);
        assert_eq!(cell(&class, "Ann_Lee_2", "Ann Lee", "counts"), expected);
        let warning = String::from_utf8(output.stderr).unwrap();
        let is_unused = warning.contains("row 2: another attempt counts instead");
        assert_eq!(is_unused, student == "Ann_Lee_1", "{warning}");
    }
}

/// Ann's first attempt has 0 points, so none can be deducted.
#[test]
fn a_row_must_fit_the_attempt_that_counts() {
    let class = TestClass::named("class")
        .with_starter("ann")
        .with_reference("u1");
    let exam = class.small_exam(&["camera.offset"]);
    let roster = "name,username,sid\nAnn Lee,ann,u1\n";
    let manual = "student,task,delta,comment,author\nann,camera,-1,,Kim\n";
    let grade = |rule: &str| {
        let policy = format!("[attempts]\ncounts = \"{rule}\"\n");
        let lists = [
            ("roster", roster),
            ("manual-points", manual),
            ("policy", &policy),
        ];
        class.graded_with(&exam, &lists, &[]);
        ["ann", "u1"].map(|id| cell(&class, id, "Ann Lee", "counts"))
    };
    let decisions = || {
        let summary: Value = serde_json::from_str(&class.read("class.json")).unwrap();
        summary["decisions"].as_array().unwrap().len()
    };
    assert_eq!(grade("ask"), ["", ""], "nobody has chosen yet");
    assert_eq!(decisions(), 1);
    assert_eq!(grade("best"), ["", "1"]);
    // The decision is only listed with the attempt that counts.
    let comments = ["ann", "u1"].map(|id| cell(&class, id, "Ann Lee", "comments"));
    assert_eq!(comments, ["", "camera: -1 point by Kim"]);
    assert_eq!(decisions(), 1);
    let page = class.read("class.html");
    assert_eq!(page.matches("by Kim").count(), 1, "{page}");
    std::fs::remove_dir_all(class.input().join("u1")).unwrap();
    let error = class.refused(&exam, &[]);
    assert!(error.contains("-1 points is out of range"), "{error}");
}
