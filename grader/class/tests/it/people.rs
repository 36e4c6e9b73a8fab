//! Rules for single people: extensions, several attempts, and points by hand.

use crate::harness::{TestClass, assert_contains, cell, successful_stdout};

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];
const DUE: &str =
    "[points]\nout_of = 100\n[late]\ndue = 2026-11-20T23:59:59Z\npercent_per_day = 10\n";

#[test]
fn extensions_move_the_due_time_of_a_person_or_a_group() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_reference("bob")
        .with_reference("carl")
        .with_reference("dora");
    // All were handed in on the second day after the due time.
    let roster = class.write_beside(
        "roster.csv",
        "name\tusername\tgroup\textension\tdatetime
Ann Lee\tann\t\t\t2026-11-22 12:00
Bob O'Hara\tbob\tOne\t1\t2026-11-22 12:00
Bea Berg\tbea\tOne\t\t2026-11-22 12:00
Carl C\tcarl\tTwo\t2026-11-22 11:00\t2026-11-22 12:00
Dora D\tdora\tThree\tsoon\t2026-11-22 12:00
",
    );
    let extensions = "timezone = 'Europe/Berlin'\n[late.extensions]\none = 2\nzoe = 3\n";
    let policy = class.write_beside("policy.toml", &format!("{DUE}{extensions}"));
    let exam = class.small_exam(&ITEMS);
    let output = class.grade(&exam, &["--policy", &policy, "--roster", &roster]);
    successful_stdout(&output);
    let counts = |submission, name| cell(&class, submission, name, "counts");
    assert_eq!(counts("ann", "Ann Lee"), "80");
    // The group's extension is longer than Bob's own.
    assert_eq!(counts("bob", "Bob O'Hara"), "100");
    assert_eq!(counts("bob", "Bea Berg"), "100");
    assert_eq!(counts("carl", "Carl C"), "90");
    assert_eq!(cell(&class, "carl", "Carl C", "late_days"), "1");
    assert_eq!(counts("dora", "Dora D"), "");
    let why = cell(&class, "dora", "Dora D", "why");
    assert!(why.contains("the extension \"soon\" is neither"), "{why}");
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.contains("an extension for \"zoe\""), "{error}");
}

#[test]
fn the_policy_says_which_of_several_attempts_counts() {
    let class = TestClass::named("class")
        .with_starter("ann")
        .with_reference("u1")
        .with_reference("bob");
    let roster = class.write_beside(
        "roster.csv",
        "name,sid,username,datetime\nAnn Lee,u1,ann,\nBob,u2,bob,\n",
    );
    let canvas = class.write_beside(
        "canvas-export.csv",
        "Student,ID,SIS User ID,SIS Login ID,Section,Path (7)\n\"Lee, Ann\",7001,u1,ann,A,\nBob,7002,u2,bob,A,\n",
    );
    let exam = class.small_exam(&ITEMS);
    let grade = |rule: &str| {
        let policy = format!("[points]\nout_of = 100\n[attempts]\ncounts = '{rule}'\n");
        let policy = class.write_beside("policy.toml", &policy);
        let lists = [
            "--policy", &policy, "--roster", &roster, "--canvas", &canvas,
        ];
        class.graded(&exam, &lists)
    };

    let text = grade("ask");
    assert!(text.contains("2 without final points, since the same person handed in several"));
    assert_contains(
        &text,
        &["Lee, Ann has several submissions (ann, u1): keep one"],
    );
    for submission in ["ann", "u1"] {
        assert_eq!(
            cell(&class, submission, "Ann Lee", "status"),
            "several attempts"
        );
        assert_eq!(cell(&class, submission, "Ann Lee", "counts"), "");
    }
    assert_eq!(cell(&class, "bob", "Bob", "counts"), "100");

    let text = grade("best");
    assert!(text.contains("2 graded"), "{text}");
    assert_eq!(cell(&class, "u1", "Ann Lee", "counts"), "100");
    assert_eq!(
        cell(&class, "ann", "Ann Lee", "status"),
        "another attempt counts"
    );
    assert!(
        class
            .read("canvas.csv")
            .contains("\"Lee, Ann\",7001,u1,ann,A,100")
    );
    let page = class.read("students/ann/feedback.html");
    assert!(page.contains("No points count: the submission u1 of the same person counts."));

    // Without times, nobody knows which is the latest.
    grade("latest");
    assert_eq!(cell(&class, "u1", "Ann Lee", "status"), "several attempts");
}

/// Returns a class of two people in a group, and one alone.
fn class_with_group() -> (TestClass, String, String) {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_starter("carl");
    let roster = class.write_beside(
        "roster.csv",
        "name,username,email,group,datetime\nAnn Lee,ann,ann@x.edu,One,2026-11-21T12:00:00Z\n\
         Bea Berg,bea,bea@x.edu,One,2026-11-21T12:00:00Z\nCarl C,carl,carl@x.edu,,2026-11-20T12:00:00Z\n",
    );
    let exam = class.small_exam(&ITEMS);
    (class, exam, roster)
}

#[test]
fn manual_points_are_added_before_lateness_and_shown_with_their_author() {
    let (class, exam, roster) = class_with_group();
    let policy = class.write_beside("policy.toml", DUE);
    let manual = class.write_beside(
        "manual.csv",
        "student,task,delta,comment,author
carl@x.edu,camera,1,=HYPERLINK(\"x\") <b>good</b> sketch,Tess
Ann Lee,sphere,-1,copied,Tess
Ann Lee,camera,0,see me,Tess
",
    );
    let arguments = [
        "--policy",
        &policy,
        "--roster",
        &roster,
        "--manual-points",
        &manual,
    ];
    class.graded(&exam, &arguments);
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
    assert_contains(
        &page,
        &[
            "Ann Lee: sphere: -1 point by Tess: copied",
            "Bea Berg: 90 of 100 points count",
        ],
    );
    // What was graded stays as it was.
    let score = class.read("students/carl/score.json");
    assert!(score.contains("\"points\": 0"), "{score}");
    assert!(!score.contains("Tess"));
}
