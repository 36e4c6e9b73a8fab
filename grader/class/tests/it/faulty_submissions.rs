//! Tests that each faulty submission gets a row, and that the points of the others are not
//! affected.

use serde_json::Value;

use crate::harness::{TestClass, successful_stdout};

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];

#[test]
fn a_faulty_submission_does_not_affect_the_others() {
    let class = TestClass::named("class")
        .with_reference("fine")
        .with_starter("=starter")
        .with_reference("panics")
        .with_replaced(
            "panics/camera.rs",
            "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {",
            "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {\n        assert!(pixel.x > 1_000_000);",
        )
        .with_reference("broken")
        .with("broken/sphere.rs", "fn (")
        .with("bad.zip", "PK\x03\x04 and no more")
        .with_folder("empty");
    let exam = class.small_exam(&ITEMS);
    let output = class.grade(&exam, &[]);
    let text = successful_stdout(&output);
    let grades = class.read("grades.csv");
    let line = |id: &str| {
        let begin = format!("{id},");
        let line = grades.lines().find(|line| line.starts_with(&begin));
        line.unwrap_or_else(|| panic!("{id}: {grades}")).to_owned()
    };
    let summary: Value = serde_json::from_str(&class.read("class.json")).unwrap();
    let most = summary["points"]["of"].as_u64().unwrap();
    assert!(line("fine").contains(&format!("graded,{most},{most},{most}")));
    // A name that a spreadsheet would take for a formula is escaped.
    assert!(line("_starter").contains("'=starter,,,,graded,0,0,"));
    assert!(
        line("bad").contains("nothing to grade,,,"),
        "{}",
        line("bad")
    );
    assert!(line("bad").contains("it is damaged"), "{}", line("bad"));
    assert!(line("empty").contains("nothing was handed in"));
    let points = |id: &str| -> u64 { line(id).split(',').nth(6).unwrap().parse().unwrap() };
    assert!((1..most).contains(&points("panics")), "{grades}");
    assert!((1..most).contains(&points("broken")), "{grades}");

    assert_eq!(summary["graded"], 4);
    assert_eq!(summary["nothing_to_grade"], 2);
    assert!(text.contains("submissions that need attention"), "{text}");
    let page = class.read("class.html");
    assert!(page.contains("href=\"students/fine/report.html\""));
    assert!(!page.contains("=starter</script"), "names must be escaped");
}

/// Programs that see the questions of a final exam must not tell students about them. The grader's
/// own tests send bits through every channel; this one shows that a class's pages are covered.
#[test]
fn the_page_for_a_student_has_nothing_that_the_program_wrote() {
    let head = "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {";
    let sends =
        |bits: u32| format!("{head}\n        println!(\"{bits}\");\n        panic!(\"{bits}\");");
    let class = TestClass::named("class")
        .with_reference("sender1")
        .with_replaced("sender1/camera.rs", head, &sends(0x9e37_79b9))
        .with_reference("sender2")
        .with_replaced("sender2/camera.rs", head, &sends(0x61c8_8646));
    let exam = class.small_exam(&ITEMS);
    successful_stdout(&class.grade(&exam, &[]));
    let page = |id: &str, name: &str| {
        let page = class.read(&format!("students/{id}/{name}.html"));
        page.replace(id, "sender")
    };
    assert_eq!(page("sender1", "feedback"), page("sender2", "feedback"));
    assert_ne!(page("sender1", "report"), page("sender2", "report"));
}

#[test]
fn late_days_cost_what_the_policy_says() {
    let metadata = "---\nsubmission_1:\n  :submitters:\n  - :name: Late\n    :email: l@x.edu\n  :created_at: 2026-11-21 00:10:00.000000000 Z\nsubmission_2:\n  :submitters:\n  - :name: Early\n    :email: e@x.edu\n  :created_at: 2026-11-20 00:10:00.000000000 Z\n";
    let class = TestClass::named("export")
        .with("submission_metadata.yml", metadata)
        .with_reference("submission_1")
        .with_reference("submission_2");
    let exam = class.small_exam(&ITEMS);
    let policy = class.write_beside(
        "policy.toml",
        "[points]\nout_of = 50\n[late]\ndue = 2026-11-20T23:59:59Z\npercent_per_day = 10\n",
    );
    successful_stdout(&class.grade(&exam, &["--policy", &policy]));
    let grades = class.read("grades.csv");
    assert!(
        grades.contains("submission_1,Late,l@x.edu,,,graded,45,"),
        "{grades}"
    );
    assert!(
        grades.contains("submission_2,Early,e@x.edu,,,graded,50,"),
        "{grades}"
    );

    let summary: Value = serde_json::from_str(&class.read("class.json")).unwrap();
    let most = summary["points"]["of"].as_u64().unwrap();
    let page = |id: &str, name: &str| class.read(&format!("students/{id}/{name}.html"));
    for name in ["feedback", "report"] {
        let late = format!(
            "45 of 50 points count towards the grade: {most} of {most} points earned, handed in 1 \
             day late, so 10 % of the points earned are deducted."
        );
        assert!(page("submission_1", name).contains(&late), "{name}");
        let early =
            format!("50 of 50 points count towards the grade: {most} of {most} points earned.");
        assert!(page("submission_2", name).contains(&early), "{name}");
    }

    successful_stdout(&class.grade(&exam, &["--drop-list", "policy"]));
    // Without a due time, the pages say nothing about the grade.
    assert!(!page("submission_1", "feedback").contains("count towards the grade"));
}

/// All but `in_time` were handed in on the third day after the due time. A time that cannot be read
/// counts neither as late nor as on time.
#[test]
fn a_time_counts_in_every_form_or_stops_that_students_grade() {
    let times = [
        ("a", "2026-11-22 23:10:00 -0800"),
        ("b", "2026-11-23 10:00"),
        ("c", "Monday, 23 November 2026, 10:00 AM"),
        ("d", "23.11.2026 10:00"),
        ("in_time", "2026-11-20 12:00"),
        ("unreadable", "yesterday"),
        ("ambiguous", "11/12/2026 10:00"),
    ];
    let class = TestClass::named("class");
    let class = times
        .iter()
        .fold(class, |class, (who, _)| class.with_reference(who));
    let rows = times.map(|(who, time)| format!("{who},{who},\"{time}\"\n"));
    let roster = format!("name,username,submission time\n{}", rows.concat());
    let roster = class.write_beside("roster.csv", &roster);
    let exam = class.small_exam(&ITEMS);
    let due = "[points]\nout_of = 100\n[late]\ndue = 2026-11-20T23:59:59Z\npercent_per_day = 10\n";
    let grade = |policy: &str| {
        let policy = class.write_beside("policy.toml", policy);
        successful_stdout(&class.grade(&exam, &["--policy", &policy, "--roster", &roster]))
    };
    let row = |who: &str| {
        let grades = class.read("grades.csv");
        let line = grades
            .lines()
            .find(|line| line.starts_with(&format!("{who},")));
        line.unwrap_or_else(|| panic!("{who}: {grades}")).to_owned()
    };

    // Without a time zone, only the time with an offset can be used.
    grade(due);
    assert!(row("a,a").contains(",graded,70,"), "{}", row("a,a"));
    let why = "it has no time zone: set `timezone` under [late] in the policy";
    assert!(row("b,b").contains(",time unclear,,"), "{}", row("b,b"));
    assert!(row("b,b").contains(why), "{}", row("b,b"));

    let printed = grade(&format!("{due}timezone = \"Europe/Berlin\"\n"));
    for who in ["a,a", "b,b", "c,c", "d,d"] {
        assert!(row(who).contains(",graded,70,"), "{}", row(who));
    }
    assert!(
        row("in_time").contains(",graded,100,"),
        "{}",
        row("in_time")
    );
    let page = class.read("class.html");
    for (who, text) in [
        ("unreadable", "yesterday"),
        ("ambiguous", "11/12/2026 10:00"),
    ] {
        assert!(row(who).contains(",time unclear,,"), "{}", row(who));
        assert!(row(who).contains(text), "{}", row(who));
        assert!(page.contains(text), "{page}");
    }
    assert!(printed.contains("2 without final points"), "{printed}");
}

/// Grades a class that contains links. Anyone can put a link into a clone or a shared folder, and
/// another student's files must not be graded as the work of the person who linked to them.
#[cfg(unix)]
#[test]
fn links_are_listed_with_the_reason_and_never_followed() {
    use std::os::unix::fs::symlink;

    let class = TestClass::named("class")
        .with_reference("alice/student/src")
        .with_folder("linked-source/student")
        .with_folder("linked-folder")
        .with_folder("linked-file")
        .with_folder("linked-archive")
        .with(".hidden/camera.rs", "text");
    let input = class.input();
    let link = |original: &str, path: &str| symlink(original, input.join(path)).unwrap();
    link("../../alice/student/src", "linked-source/student/src");
    link("../alice/student", "linked-folder/student");
    link("../alice/student/src/camera.rs", "linked-file/camera.rs");
    link("alice", "linked-student");
    link("../alice.zip", "linked-archive/work.zip");
    let exam = class.small_exam(&ITEMS);
    successful_stdout(&class.grade(&exam, &[]));
    let grades = class.read("grades.csv");
    let line = |id: &str| {
        let line = grades.lines().find(|line| line.starts_with(id));
        line.unwrap_or_else(|| panic!("{id}: {grades}")).to_owned()
    };
    assert!(line("alice,").contains("graded"));
    for (id, link) in [
        ("linked-source,", "student/src"),
        ("linked-folder,", "student"),
        ("linked-file,", "camera.rs"),
        ("linked-student,", "linked-student"),
        ("linked-archive,", "work.zip"),
    ] {
        let (line, why) = (line(id), format!("{link} is a link"));
        assert!(line.contains("nothing to grade,,,"), "{line}");
        assert!(line.contains(&why), "{line}");
    }
    assert!(class.preview().contains(".hidden"), "{}", class.preview());
}

/// A file mode stops everybody but root, so root skips this test.
#[cfg(unix)]
#[test]
fn an_unreadable_folder_is_listed_with_the_reason() {
    use std::fs::{self, Permissions};
    use std::os::unix::fs::PermissionsExt;

    let class = TestClass::named("class")
        .with_reference("alice")
        .with_folder("locked")
        .with_reference("partly locked/old")
        .with_folder("partly locked/src");
    let locked = [
        class.input().join("locked"),
        class.input().join("partly locked/src"),
    ];
    let set_mode = |mode| {
        for folder in &locked {
            fs::set_permissions(folder, Permissions::from_mode(mode)).unwrap();
        }
    };
    set_mode(0o000);
    let is_root = fs::read_dir(&locked[0]).is_ok();
    let preview = class.preview();
    set_mode(0o755);
    if is_root {
        eprintln!("SKIPPED: root can read every folder");
        return;
    }
    let line = "locked: nothing to grade: the folder or file cannot be read: permission denied";
    assert!(preview.contains(line), "{preview}");
    assert!(preview.contains("alice: all 5 files"), "{preview}");
    assert!(preview.contains("partly locked: all 5 files"), "{preview}");
}
