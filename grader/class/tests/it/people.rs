//! Rules for single people: extensions, several attempts, and points by hand.

use std::fs;

use crate::harness::{TestClass, cell, class_command, exit_code_and_stderr, successful_stdout};

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
        successful_stdout(&class.grade(&exam, &lists))
    };

    let text = grade("ask");
    assert!(text.contains("2 without final points, since the same person handed in several"));
    assert!(
        text.contains("Lee, Ann has several submissions (ann, u1): keep one"),
        "{text}"
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

#[test]
fn the_latest_attempt_counts_if_all_times_are_known() {
    let metadata = |submission: u32, time: &str| {
        format!(
            "submission_{submission}:\n  :submitters:\n  - :name: Ann\n    :email: a@x.edu\n  :created_at: {time}\n"
        )
    };
    let times = ["2026-11-20 12:00:00 Z", "2026-11-20 14:00:00 +0300"];
    let export = |second: &str| format!("---\n{}{}", metadata(1, times[0]), metadata(2, second));
    let class = TestClass::named("export")
        .with("submission_metadata.yml", export(times[1]))
        .with_reference("submission_1")
        .with_starter("submission_2");
    let exam = class.small_exam(&ITEMS);
    let policy = class.write_beside("policy.toml", "[attempts]\ncounts = 'latest'\n");
    let status = |class: &TestClass, submission| cell(class, submission, "Ann", "status");
    successful_stdout(&class.grade(&exam, &["--policy", &policy]));
    assert_eq!(status(&class, "submission_1"), "graded");
    assert_eq!(status(&class, "submission_2"), "another attempt counts");
    let class = class.with("submission_metadata.yml", export("later"));
    successful_stdout(&class.grade(&exam, &["--policy", &policy]));
    for submission in ["submission_1", "submission_2"] {
        assert_eq!(status(&class, submission), "several attempts");
    }
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
    successful_stdout(&class.grade(&exam, &arguments));
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
    assert!(
        page.contains("Ann Lee: sphere: -1 point by Tess: copied"),
        "{page}"
    );
    assert!(page.contains("Bea Berg: 90 of 100 points count"), "{page}");
    // What was graded stays as it was.
    let score = class.read("students/carl/score.json");
    assert!(score.contains("\"points\": 0"), "{score}");
    assert!(!score.contains("Tess"));

    // A shard has only some of the people, and its results can be merged.
    let part = class.path_beside("part");
    let shard = |number: u32| {
        let shard = format!("{number}/2");
        let mut command = class_command();
        command
            .arg(class.input())
            .args(["--exam", &exam, "--no-reference"]);
        command
            .args(["--isolation", "none", "--shard", &shard])
            .args(arguments);
        command.arg("--out").arg(part.join(number.to_string()));
        successful_stdout(&command.output().unwrap());
    };
    [1, 2].into_iter().for_each(shard);
    let alone = class.read("grades.csv");
    fs::remove_dir_all(class.out()).unwrap();
    let mut command = class_command();
    command.arg("merge").args([part.join("1"), part.join("2")]);
    command.arg("--out").arg(class.out()).args(arguments);
    successful_stdout(&command.output().unwrap());
    assert_eq!(class.read("grades.csv"), alone);
}

#[test]
fn a_mistake_in_manual_points_names_its_row_and_nothing_is_written() {
    let (class, exam, roster) = class_with_group();
    let reject = |rows: &str| {
        let text = format!("student,task,delta,comment,author\ncarl,sphere,1,,Tess\n{rows}");
        let manual = class.write_beside("manual.csv", &text);
        let output = class.grade(&exam, &["--roster", &roster, "--manual-points", &manual]);
        let (code, error) = exit_code_and_stderr(&output);
        assert_eq!(code, 2, "{error}");
        assert!(!class.out().join("grades.csv").exists());
        let last = error.lines().last().unwrap();
        last.replace(&manual, "manual.csv")
    };
    let rejections = [
        "dave,camera,1,,Tess\n",
        "bea,light,1,,Tess\n",
        "bea,camera,NaN,,Tess\n",
        "bea,camera,0.5,,Tess\n",
        "bea,camera,1,,\n",
        "carl@x.edu,sphere,1,,Tess\n",
        "ann,camera,1,,Tess\n",
        "carl,camera,-1,,Tess\n",
        "carl,bvh,1,,Tess\n",
        "carl,build,1,,Tess\n",
    ];
    insta::assert_snapshot!(rejections.map(reject).join("\n"));
}

#[test]
fn a_roster_with_one_key_for_two_people_is_refused() {
    let (class, exam, _) = class_with_group();
    let grade = |rows: &str| {
        let roster = class.write_beside("roster.csv", &format!("name,username,email\n{rows}"));
        exit_code_and_stderr(&class.grade(&exam, &["--roster", &roster]))
    };
    let (code, error) = grade("Ann,ann,a@x.edu\nCarl,carl,c@x.edu\nAnna,anna,A@x.edu\n");
    assert_eq!(code, 2);
    assert!(
        error.contains("rows 2 and 4 both have \"A@x.edu\""),
        "{error}"
    );
    let (code, error) = grade("Ann,ann,a@x.edu\nCarl,carl,c@x.edu\nAnn,ann,A@x.edu\n");
    assert_eq!(code, 0, "{error}");
}
