//! Rules for individual people: extensions, several attempts and manual points.

use crate::harness::{TestClass, assert_contains, cell, successful_stdout};

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
        "2 without final points, since the same person handed in several",
        "Lee, Ann has several submissions (ann, u1): keep one",
    ];
    assert_contains(&text, &several);
    let ann = |submission, column| cell(&class, submission, "Ann Lee", column);
    for submission in ["ann", "u1"] {
        assert_eq!(ann(submission, "status"), "several attempts");
        assert_eq!(ann(submission, "counts"), "");
    }
    assert_eq!(cell(&class, "bob", "Bob", "counts"), "100");

    assert_contains(&grade("best"), &["2 graded"]);
    assert_eq!(ann("u1", "counts"), "100");
    assert_eq!(ann("ann", "status"), "another attempt counts");
    let row = "\"Lee, Ann\",7001,u1,ann,A,100";
    assert_contains(&class.read("canvas.csv"), &[row]);
    let text = "No points count: the submission u1 of the same person counts.";
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
    assert_contains(&error, &["an extension for \"zoe\""]);
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
    let comment = cell(&class, "carl", "Carl C", "comments");
    assert_eq!(
        comment,
        "camera: +1 point by Tess: =HYPERLINK(\"x\") <b>good</b> sketch"
    );

    let page = class.read("students/carl/feedback.html");
    let line = "camera: +1 point by Tess: =HYPERLINK(&quot;x&quot;) &lt;b&gt;good&lt;/b&gt; sketch";
    assert!(page.contains(line), "{page}");
    assert!(page.contains("1 point added by hand"));
    let page = class.read("students/ann/feedback.html");
    let expected = [
        "Ann Lee: sphere: -1 point by Tess: copied",
        "Bea Berg: 90 of 100 points count",
    ];
    assert_contains(&page, &expected);
    // The graded files stay unchanged.
    let score = class.read("students/carl/score.json");
    assert!(score.contains("\"points\": 0"), "{score}");
    assert!(!score.contains("Tess"));
}
