//! Tests that each faulty submission gets a row without affecting the points of the others, and
//! that a machine fault is retried and gives no score if it persists.

use std::process::Output;

use serde_json::Value;

use crate::harness::{
    TestClass, all_files, assert_contains, cell, exit_code_and_stderr, successful_stdout,
};

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
    let summary: Value = serde_json::from_str(&class.read("class.json")).unwrap();
    let most = summary["points"]["of"].as_u64().unwrap();
    let of =
        |id: &str, columns: [&'static str; 4]| columns.map(|column| cell(&class, id, id, column));
    let points = |id: &str| of(id, ["status", "counts", "points", "max_points"]);
    let all = most.to_string();
    assert_eq!(points("fine"), ["graded", &all, &all, &all]);
    // A name that a spreadsheet would interpret as a formula is escaped.
    let counts = cell(&class, "_starter", "'=starter", "counts");
    assert_eq!(counts, "0");
    for (id, reason) in [("bad", "it is damaged"), ("empty", "nothing was handed in")] {
        let [status, counts, points, why] = of(id, ["status", "counts", "points", "why"]);
        assert_eq!([&*status, &counts, &points], ["nothing to grade", "", ""]);
        assert!(why.contains(reason), "{why}");
    }
    for id in ["panics", "broken"] {
        let points = points(id)[2].parse().unwrap();
        assert!((1..most).contains(&points), "{id}: {points}");
    }

    assert_eq!(summary["graded"], 4);
    assert_eq!(summary["nothing_to_grade"], 2);
    assert!(text.contains("submissions that need attention"), "{text}");
    let page = class.read("class.html");
    assert!(page.contains("href=\"students/fine/report.html\""));
    assert!(!page.contains("=starter</script"), "names must be escaped");
}

/// Programs that see the questions in a final exam must not reveal the questions to students. The
/// grader's own tests try to leak bits through every channel. This test shows that the pages for
/// students don't leak any bits either.
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
    class.graded(&exam, &[]);
    let page = |id: &str, name: &str| {
        let page = class.read(&format!("students/{id}/{name}.html"));
        page.replace(id, "sender")
    };
    assert_eq!(page("sender1", "feedback"), page("sender2", "feedback"));
    assert_ne!(page("sender1", "report"), page("sender2", "report"));
}

/// Grades a class that contains links. Anyone can put a link into a clone or a shared folder, and
/// another student's files must not be graded as the work of the person who made the link.
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
    class.graded(&exam, &[]);
    assert_eq!(cell(&class, "alice", "alice", "status"), "graded");
    for (id, link) in [
        ("linked-source", "student/src"),
        ("linked-folder", "student"),
        ("linked-file", "camera.rs"),
        ("linked-student", "linked-student"),
        ("linked-archive", "work.zip"),
    ] {
        let row = ["status", "counts", "points", "why"].map(|column| cell(&class, id, id, column));
        let [status, counts, points, why] = row.each_ref().map(String::as_str);
        assert_eq!([status, counts, points], ["nothing to grade", "", ""]);
        assert!(why.starts_with(&format!("{link} is a link")), "{id}: {why}");
    }
    assert!(class.preview().contains(".hidden"), "{}", class.preview());
}

/// File permissions don't restrict root, so this test is skipped when root runs it.
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
    assert_contains(&preview, &[line]);
    assert_contains(&preview, &["alice", "partly locked"].map(all_files));
}

/// A linker that fails while a file `fault-*` exists next to it. Each failure removes one such
/// file. Like every linker started by the grader, it runs without a PATH.
#[cfg(unix)]
const LINKER: &str = r#"
PATH=/usr/local/bin:/usr/bin:/bin
here=$(dirname "$0")
for fault in "$here"/fault-*; do
    if [ -e "$fault" ]; then
        rm "$fault"
        echo "No space left on device" >&2
        exit 1
    fi
done
exec cc "$@"
"#;

#[cfg(unix)]
fn grade_with_faults(faults: usize, class: &TestClass, exam: &str) -> Output {
    use std::fs;

    use test_support::programs::{path_with, write_program};

    let tools = class.path_beside("tools");
    write_program(&tools.join("cc"), LINKER);
    for fault in 0..faults {
        fs::write(tools.join(format!("fault-{fault}")), "").unwrap();
    }
    let mut run = class.command(exam, &[]);
    let output = run.env("PATH", path_with(&tools)).output().unwrap();
    let unused = fs::read_dir(&tools).unwrap().count() - 1;
    assert!(
        faults == 0 || unused < faults,
        "the linker must have been called"
    );
    for fault in 0..faults {
        fs::remove_file(tools.join(format!("fault-{fault}"))).ok();
    }
    output
}

#[cfg(unix)]
#[test]
fn a_transient_fault_is_retried_and_a_lasting_fault_gives_no_score() {
    let class = TestClass::named("class").with_reference("ann");
    let exam = class.small_exam(&ITEMS);

    let output = grade_with_faults(1000, &class, &exam);
    let (code, error) = exit_code_and_stderr(&output);
    assert_eq!(code, 3, "{error}");
    assert_contains(
        &error,
        &["not graded because of a problem with the grader or the machine"],
    );
    let ann = |column| cell(&class, "ann", "ann", column);
    assert_eq!([ann("status"), ann("points")], ["not graded", ""]);
    let score = class.out().join("students/ann/score.json");
    assert!(!score.exists(), "there must be no score");

    let text = successful_stdout(&grade_with_faults(1, &class, &exam));
    assert!(!text.contains("not graded"), "{text}");
    assert_eq!(
        [ann("status"), ann("counts")],
        ["graded".to_owned(), ann("points")]
    );
}
