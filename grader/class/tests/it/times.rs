//! Submission times, extensions and late flags, in the formats of rosters and platforms.

use crate::harness::{TestClass, assert_contains, cell, source};
use crate::page::section;

const POLICY: &str = "[late]\ndue = 2026-10-20T23:59:00+02:00\ntimezone = 'Europe/Berlin'\n\
                      percent_per_day = 10\n";

/// Grades a class of single-file submissions with the policy and this list.
fn grade(class: &TestClass, list: &str, text: &str) -> String {
    let exam = class.small_exam(&["camera.offset"]);
    class.graded_with(&exam, &[("policy", POLICY), (list, text)], &[])
}

fn camera() -> String {
    source("reference/src/camera.rs")
}

/// Returns the status, the late days and the reason for one person.
fn lateness(class: &TestClass, submission: &str, name: &str) -> [String; 3] {
    ["status", "late_days", "why"].map(|column| cell(class, submission, name, column))
}

fn assert_late_days(class: &TestClass, submission: &str, name: &str, days: &str) {
    let expected = ["graded", days, ""];
    assert_eq!(lateness(class, submission, name), expected, "{submission}");
}

fn assert_open(class: &TestClass, submission: &str, name: &str, status: &str, reason: &str) {
    let [actual, _, why] = lateness(class, submission, name);
    assert_eq!(actual, status, "{submission}: {why}");
    assert!(why.contains(reason), "{submission}: {why}");
    assert_eq!(cell(class, submission, name, "counts"), "");
}

/// Canvas says that a submission is late, but not how late.
#[test]
fn a_late_flag_without_a_time_is_said_to_count_as_one_day() {
    let class = TestClass::named("submissions")
        .with("doejane_LATE_7001_9001_camera.rs", camera())
        .with("leeann_7002_9002_camera.rs", camera());
    let exam = class.small_exam(&["camera.offset"]);
    let policy = ("policy", "[late]\npercent_per_day = 10\n");
    let printed = class.graded_with(&exam, &[policy], &["--hand-back"]);
    assert_contains(&printed, &["1 counted as on time or 1 day late because"]);
    let sentence =
        "handed in late (counted as 1 day, because the submission time is unknown), so 10% of";
    for page in ["class.html", "students/doejane_7001/feedback.html"] {
        assert_contains(&class.read(page), &[sentence]);
    }
    let times = "or as 1 day late if the platform marks them as late: doejane_7001 (doejane).";
    assert_contains(&class.read("class.html"), &[times]);
}

#[test]
fn a_wrong_year_is_never_on_time_or_late() {
    let rows = [
        ("excel", "25.10.26 23:30", ""),
        ("extended", "2026-10-25 20:00", "26.10.26 23:59"),
        ("ancient", "25.10.0026 23:30", ""),
        ("last", "2025-10-20 12:00", ""),
        ("typo", "20.10.62 12:00", ""),
        ("serial", "2026-10-25 20:00", "46318"),
        ("slashes", "25/10/26 23:30", ""),
    ];
    let mut class = TestClass::named("class");
    let mut roster = "username,name,datetime,extension\n".to_owned();
    for (name, time, extension) in rows {
        class = class.with(&format!("{name}/camera.rs"), camera());
        roster += &format!("{name},{name},{time},{extension}\n");
    }
    grade(&class, "roster", &roster);
    let is_open = |name, reason| assert_open(&class, name, name, "time unclear", reason);
    assert_late_days(&class, "excel", "excel", "5");
    assert_late_days(&class, "extended", "extended", "0");
    is_open("ancient", "its year is not between 2000 and 2099");
    is_open("last", "more than half a year from the due time");
    is_open("typo", "more than half a year from the due time");
    is_open("serial", "more than half a year from the due time");
    is_open("slashes", "it is ambiguous");
}

/// Winter time begins on 25 October.
#[test]
fn days_end_at_the_same_time_of_day_when_clocks_are_set() {
    let class = TestClass::named("class")
        .with("extended/camera.rs", camera())
        .with("late/camera.rs", camera());
    let time = "2026-10-27 23:58";
    let roster = format!("name,datetime,extension\nextended,{time},7\nlate,{time},\n");
    grade(&class, "roster", &roster);
    assert_late_days(&class, "extended", "extended", "0");
    assert_late_days(&class, "late", "late", "7");
}

#[test]
fn a_list_does_not_overrule_the_late_flags_of_canvas() {
    let class = TestClass::named("class")
        .with("LATE_anon_aB3x9_9001_camera.rs", camera())
        .with("anon_cD4y0_9002_camera.rs", camera())
        .with("early_LATE_1_9003_camera.rs", camera())
        .with("late_2_9004_camera.rs", camera())
        .with("equal_LATE_3_9005_camera.rs", camera());
    let roster = "name,datetime\nearly,2026-10-19 12:00\nlate,2026-10-22 12:00\n\
                  equal,2026-10-22 12:00\n";
    grade(&class, "roster", roster);
    assert_late_days(&class, "anon_aB3x9", "anon aB3x9", "1");
    assert_late_days(&class, "anon_cD4y0", "anon cD4y0", "0");
    assert_late_days(&class, "equal_3", "equal", "2");
    let is_open = |id, name, reason| assert_open(&class, id, name, "time unclear", reason);
    is_open(
        "early_1",
        "early",
        "the platform marks the submission as late",
    );
    is_open(
        "late_2",
        "late",
        "the platform does not mark the submission as late",
    );

    let flag = |id, name| cell(&class, id, name, "late_flag");
    assert_eq!(flag("anon_aB3x9", "anon aB3x9"), "LATE");
    assert_eq!(flag("anon_cD4y0", "anon cD4y0"), "");
    let page = class.read("class.html");
    assert_eq!(page.matches("marked LATE by the platform").count(), 3);
}

#[test]
fn the_status_in_moodles_worksheet_has_extensions_and_drafts() {
    let until = "Extension granted until:";
    let english = format!("{until} Monday, 26 October 2026, 11:59 PM");
    let rows = [
        ("Ext", format!("Submitted for grading - {english}")),
        (
            "Late",
            "Submitted for grading - 4 days 12 hours late - Graded - follow up submission received"
                .to_owned(),
        ),
        (
            "Draft",
            "Draft (not submitted) - Assignment is overdue by: 5 days - Not marked".to_owned(),
        ),
        ("None", String::new()),
        (
            "Other",
            format!("Submitted for grading - {until} lundi 26 octobre 2026, 23:59"),
        ),
        ("German", "Entwurf (nicht abgegeben)".to_owned()),
    ];
    let mut class = TestClass::named("class");
    let mut worksheet = "Identifier,Full name,Status,Grade,Last modified (submission)\n".to_owned();
    for (number, (name, status)) in rows.iter().enumerate() {
        let folder = format!("{name}_{number}_assignsubmission_file_");
        class = class.with(&format!("{folder}/camera.rs"), camera());
        let time = "\"Sunday, 25 October 2026, 11:30 AM\"";
        worksheet += &format!("Participant {number},{name},\"{status}\",,{time}\n");
    }
    let text = grade(&class, "moodle", &worksheet);
    assert_late_days(&class, "Ext_0", "Ext", "0");
    assert_late_days(&class, "Late_1", "Late", "5");
    assert_late_days(&class, "None_3", "None", "5");
    let flag = |id, name| cell(&class, id, name, "late_flag");
    assert_eq!(
        [flag("Late_1", "Late"), flag("None_3", "None")],
        ["LATE", ""]
    );
    let draft = "the status in Moodle's worksheet is \"Draft (not submitted)\"";
    assert_open(&class, "Draft_2", "Draft", "draft", draft);
    let is_open = |id, name, reason| assert_open(&class, id, name, "time unclear", reason);
    is_open(
        "Other_4",
        "Other",
        "the extension \"lundi 26 octobre 2026, 23:59\"",
    );
    is_open("German_5", "German", "switch Moodle to English");
    let expected = [
        "Draft: the status in Moodle's worksheet",
        "2 without final points, because it is unclear when they were submitted",
        "1 saved only as a draft, so there are no final points yet",
    ];
    assert_contains(&text, &expected);
}

#[test]
fn the_test_student_is_counted_separately() {
    let class = TestClass::named("class")
        .with("leeann_7001_9001_camera.rs", camera())
        .with("kimbob_LATE_7002_9002_camera.rs", camera())
        .with("studenttest_7009_9009_camera.rs", camera());
    let gradebook = "Student,ID,SIS Login ID,Section,Path (7)\n\
                     \"Lee, Ann\",7001,ann,A,\n\"Kim, Bob\",7002,bob,A,\n";
    let text = grade(&class, "canvas", gradebook);
    let expected = [
        "2 graded, small exam",
        "1 submitted by Canvas's test student",
        "2 counted as on time or 1 day late",
    ];
    assert_contains(&text, &expected);
    let page = class.read("class.html");
    let expected = "2 graded, 0 with nothing to grade, 0 not graded, 1 submitted by Canvas's test \
                    student, 0 without a submission.";
    assert_contains(&page, &[expected]);
    let times = "Submission times\nHanded in | Students\non time | 1\n1 day late | 1\n";
    assert_contains(&section(&page, "times"), &[times]);
}
