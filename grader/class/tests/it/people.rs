//! Rules for individual people: extensions, several attempts and manual points.

use crate::harness::{TestClass, assert_contains, cell, source, successful_stdout};

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];
const DUE: &str =
    "[points]\nout_of = 100\n[late]\ndue = 2026-11-20T23:59:59Z\npercent_per_day = 10\n";

#[test]
fn the_policy_says_which_of_several_attempts_counts() {
    let class = TestClass::named("class")
        .with_starter("ann")
        .with_reference("u1")
        .with_reference("bob");
    let roster = "name,sid,username,datetime\nAnn Lee,u1,ann,\nBob,u2,bob,\n";
    let canvas = "Student,ID,SIS User ID,SIS Login ID,Section,Path (7)\n\
                  \"Lee, Ann\",7001,u1,ann,A,\nBob,7002,u2,bob,A,\n";
    let exam = class.small_exam(&ITEMS);
    let grade = |rule: &str| {
        let policy = format!("[points]\nout_of = 100\n[attempts]\ncounts = '{rule}'\n");
        let lists = [("policy", &*policy), ("roster", roster), ("canvas", canvas)];
        class.graded_with(&exam, &lists, &[])
    };

    let text = grade("ask");
    let several = [
        "2 without final points, because the same person handed in several submissions",
        "Lee, Ann has several submissions (ann, u1), so this row is left unchanged: keep only one submission",
    ];
    assert_contains(&text, &several);
    let ann = |submission, column| cell(&class, submission, "Ann Lee", column);
    for submission in ["ann", "u1"] {
        assert_eq!(ann(submission, "status"), "several attempts");
        assert_eq!(ann(submission, "counts"), "");
        let page = class.read(&format!("students/{submission}/feedback.html"));
        assert_contains(
            &page,
            &[
                "None of the points count yet: the course staff still have to review this submission.",
            ],
        );
        assert!(!page.contains("[attempts]"), "this is for staff: {page}");
    }
    assert_eq!(cell(&class, "bob", "Bob", "counts"), "100");

    assert_contains(&grade("best"), &["2 graded"]);
    assert_eq!(ann("u1", "counts"), "100");
    assert_eq!(ann("ann", "status"), "another attempt counts");
    let row = "\"Lee, Ann\",7001,u1,ann,A,100";
    assert_contains(&class.read("canvas.csv"), &[row]);
    let text = "None of the points count towards the grade: submission u1 from the same person \
                counts instead.";
    assert_contains(&class.read("students/ann/feedback.html"), &[text]);

    // Without times, the latest attempt is unknown.
    grade("latest");
    assert_eq!(ann("u1", "status"), "several attempts");
}

/// Ann and Bea are a group.
#[test]
fn manual_points_are_added_before_lateness_and_shown_with_their_author() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_starter("carl");
    let exam = class.small_exam(&ITEMS);
    let roster = "name,username,email,group,datetime\n\
                  Ann Lee,ann,ann@x.edu,One,2026-11-21T12:00:00Z\n\
                  Bea Berg,bea,bea@x.edu,One,2026-11-21T12:00:00Z\n\
                  Carl C,carl,carl@x.edu,,2026-11-20T12:00:00Z\n";
    let manual = "student,task,delta,comment,author
carl@x.edu,camera,1,=HYPERLINK(\"x\") <b>good</b> sketch,Tess
Ann Lee,sphere,-1,copied,Tess
Ann Lee,camera,0,see me,Tess
";
    let policy = format!("{DUE}[late.extensions]\nzoe = 3\n");
    let lists = [
        ("policy", &*policy),
        ("roster", roster),
        ("manual-points", manual),
    ];
    let lists = class.lists(&lists);
    let output = class.grade(&exam, &lists.iter().map(String::as_str).collect::<Vec<_>>());
    successful_stdout(&output);
    let error = String::from_utf8(output.stderr).unwrap();
    assert_contains(
        &error,
        &[
            "an extension for \"zoe\", which doesn't match any person or group in this class: use a name",
        ],
    );
    let of = |submission, name| {
        ["counts", "points", "manual", "late_days"]
            .map(|column| cell(&class, submission, name, column))
            .join(" ")
    };
    let most: f64 = cell(&class, "ann", "Ann Lee", "max_points")
        .parse()
        .unwrap();
    let counts = |points: f64| (100.0 * points / most).round();
    assert_eq!(
        of("ann", "Ann Lee"),
        format!("{} {most} -1 1", counts(0.9 * (most - 1.0)))
    );
    assert_eq!(of("ann", "Bea Berg"), format!("90 {most}  1"));
    assert_eq!(of("carl", "Carl C"), format!("{} 0 1 0", counts(1.0)));
    assert_eq!(cell(&class, "carl", "Carl C", "counts_max"), "100");
    assert_contains(&class.read("class.html"), &["Counts (of 100)"]);
    assert_contains(&class.read("class.json"), &["\"counts_max\": 100"]);
    let comment = cell(&class, "carl", "Carl C", "comments");
    assert_eq!(
        comment,
        "camera: +1 point by Tess: =HYPERLINK(\"x\") <b>good</b> sketch"
    );

    let page = class.read("students/carl/feedback.html");
    let line = "camera: +1 point by Tess: =HYPERLINK(&quot;x&quot;) &lt;b&gt;good&lt;/b&gt; sketch";
    assert!(page.contains(line), "{page}");
    assert!(page.contains("1 point added by hand"));
    let expected = [
        "Ann Lee: sphere: -1 point by Tess: copied",
        "Bea Berg: 90 of 100 points count",
    ];
    assert_contains(&class.read("students/ann/report.html"), &expected);
    // The page is for both, and neither may see the other's points.
    let page = class.read("students/ann/feedback.html");
    let expected = "The members of this group have different final points";
    assert_contains(&page, &[expected]);
    assert!(
        !page.contains("Tess") && !page.contains("points count"),
        "{page}"
    );
    // The graded files stay unchanged.
    let score = class.read("students/carl/score.json");
    assert!(score.contains("\"points\": 0"), "{score}");
    assert!(!score.contains("Tess"));
}

/// Three people are called Ann Lee, one of them only in Canvas, which writes the family name first.
#[test]
fn namesakes_are_told_apart_or_belong_to_nobody() {
    let roster = "name,email,username\nAnn Lee,a1@x.edu,a1\nAnn Lee,a2@x.edu,a2\n";
    let class = TestClass::named("class")
        .with_minimal_submission("Ann Lee")
        .with_minimal_submission("a1@x.edu");
    let roster = class.write_beside("roster.csv", roster);
    let preview = class.previewed(&["--roster", &roster]);
    let expected = [
        "Ann Lee: several people on the lists are named Ann Lee",
        "so that it contains one of a1@x.edu, a2@x.edu",
        "without a submission:\n      Ann Lee (a2@x.edu)\n",
    ];
    assert_contains(&preview, &expected);
    assert_eq!(preview.matches("several people").count(), 1);
    // Until the name is replaced, nobody gets these points.
    let exam = class.small_exam(&["camera.offset"]);
    class.graded(&exam, &["--roster", &roster]);
    assert_eq!(
        cell(&class, "Ann_Lee", "Ann Lee", "status"),
        "person unclear"
    );
    assert_eq!(cell(&class, "Ann_Lee", "Ann Lee", "counts"), "");
    assert_contains(&class.read("class.html"), &[">Ann Lee (a2@x.edu)<"]);
    let canvas = "Student,ID,SIS Login ID,Section,Path (7)\n\"Lee, Ann\",7001,,A,\n\
                  \"Lee, Ann\",7002,,A,\n";
    let text = class.graded_with(&exam, &[("canvas", canvas)], &[]);
    let expected = "! Ann Lee (a1@x.edu) could be any of Lee, Ann (7001); Lee, Ann (7002): ";
    assert_contains(&text, &[expected]);

    let class = TestClass::named("submissions")
        .with(
            "leeann_7001_9001_camera.rs",
            source("reference/src/camera.rs"),
        )
        .with(
            "leeann_7002_9002_camera.rs",
            source("grader/starter/camera.rs"),
        );
    let canvas = "Student,ID,SIS Login ID,Section,Path (7)\n\
                  \"Lee, Ann\",7001,a1,A,\n\"Lee, Ann\",7002,a2,A,\n";
    let exam = class.small_exam(&["camera.offset"]);
    let text = class.graded_with(&exam, &[("canvas", canvas)], &[]);
    assert_contains(&text, &["Lee, Ann (7001)  – → 2", "Lee, Ann (7002)  – → 0"]);
    assert_eq!(cell(&class, "leeann_7001", "Ann Lee", "username"), "a1");
}

/// Canvas's list shares only a name with the roster.
#[test]
fn a_person_known_by_different_identifiers_is_not_missing() {
    let class = TestClass::named("class").with_minimal_submission("bob@x.edu");
    let canvas = "Student,ID,SIS Login ID,Section,Path (7)\n\"Kim, Bob\",7001,bk,A,\n\
                  \"Ray, Eve\",7002,er,A,\n";
    let lists = [
        ("roster", "name,email\nBob Kim,bob@x.edu\n"),
        ("canvas", canvas),
    ];
    let preview = class.previewed_with(&lists, &[]);
    assert_contains(&preview, &["without a submission:\n      Eve Ray\n\n"]);
}

/// The account `team-7` has a row in classroom50's list, but belongs to two people in the roster. The
/// list gives the time of their submission.
#[test]
fn the_row_of_a_groups_own_account_in_classroom50_is_about_its_members() {
    let scores = "username,first_name,last_name,email,datetime,late\n\
                  ann,Ann,Lee,ann@x.edu,2026-11-20T10:00:00Z,false\n\
                  bob,Bob,Kim,bob@x.edu,,\n\
                  eve,Eve,Ray,eve@x.edu,,\n\
                  team-7,,,,2026-11-22T10:00:00Z,true\n";
    let class = TestClass::named("2026-11-29")
        .with_starter("cg-ann/student/src")
        .with("cg-ann/result.json", "{}")
        .with_reference("cg-team-7/student/src")
        .with("cg-team-7/result.json", "{}")
        .with("scores.csv", scores);
    let exam = class.small_exam(&ITEMS);
    let roster = "name,username,group\nAnn Lee,ann,\nBob Kim,bob,Team 7\nEve Ray,eve,Team 7\n";
    class.graded_with(&exam, &[("roster", roster), ("policy", DUE)], &[]);
    let of = |id: &str, name: &str| {
        ["status", "late_days", "late_flag", "counts"].map(|column| cell(&class, id, name, column))
    };
    assert_eq!(of("ann", "Ann Lee"), ["graded", "0", "", "0"]);
    for name in ["Bob Kim", "Eve Ray"] {
        assert_eq!(of("team-7", name), ["graded", "2", "LATE", "80"], "{name}");
    }
    assert!(!class.read("grades.csv").contains("nothing submitted"));
    // Without the group, the account is all that is known.
    let roster = "name,username\nAnn Lee,ann\nBob Kim,bob\nEve Ray,eve\n";
    class.graded_with(&exam, &[("roster", roster)], &[]);
    assert_eq!(of("team-7", ""), ["graded", "2", "LATE", "80"]);
}

/// The roster names the tutors, and the list next to the clones gives the submission times.
#[test]
fn the_list_in_a_download_counts_beside_a_roster_and_in_later_runs() {
    let scores = "username,first_name,last_name,email,datetime,late\n\
                  ann,Ann,Lee,ann@x.edu,2026-11-22T10:00:00Z,true\n\
                  bob,Bob,Kim,bob@x.edu,2026-11-22T10:00:00Z,true\n\
                  zoe,Zoë,Z,zoe@x.edu,,\n";
    let class = TestClass::named("2026-11-29")
        .with_reference("cg-ann/student/src")
        .with("cg-ann/result.json", "{}")
        .with_reference("cg-bob/student/src")
        .with("cg-bob/result.json", "{}")
        .with("scores.csv", scores);
    let exam = class.small_exam(&ITEMS);
    // The roster corrects one of the times.
    let roster = "username,tutor,datetime\nann,Tess,\nbob,Uwe,2026-11-20T10:00:00Z\n";
    class.graded_with(&exam, &[("roster", roster), ("policy", DUE)], &[]);
    let first = class.read("grades.csv");
    let late = |id: &str, name: &str| cell(&class, id, name, "late_days");
    assert_eq!([late("ann", "Ann Lee"), late("bob", "Bob Kim")], ["2", "0"]);
    assert_contains(&first, &["Zoë Z,zoe@x.edu,,zoe,nothing submitted"]);
    std::fs::remove_file(class.input().join("scores.csv")).unwrap();
    class.graded(&exam, &[]);
    assert_eq!(class.read("grades.csv"), first);
}
