//! Faults of the machine: grading is tried again. If the fault remains, it is reported and the
//! submission has no score.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::Output;

use crate::harness::{TestClass, assert_contains, exit_code_and_stderr, successful_stdout};

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];

/// A linker that fails if there is a file `fault-*` next to it. Each failure removes one such file.
/// It has no PATH, like every linker that the grader starts.
const LINKER: &str = r#"#!/bin/sh
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

fn grade_with_faults(faults: usize, class: &TestClass, exam: &str) -> Output {
    let tools = class.path_beside("tools");
    fs::create_dir_all(&tools).unwrap();
    let linker = tools.join("cc");
    fs::write(&linker, LINKER).unwrap();
    fs::set_permissions(&linker, fs::Permissions::from_mode(0o755)).unwrap();
    for fault in 0..faults {
        fs::write(tools.join(format!("fault-{fault}")), "").unwrap();
    }
    let path = format!("{}:{}", tools.display(), std::env::var("PATH").unwrap());
    let mut run = class.command(exam, &[]);
    let output = run.env("PATH", path).output().unwrap();
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

#[test]
fn a_transient_fault_is_retried_and_a_lasting_fault_gives_no_score() {
    let class = TestClass::named("class").with_reference("ann");
    let exam = class.small_exam(&ITEMS);

    let output = grade_with_faults(1000, &class, &exam);
    let (code, error) = exit_code_and_stderr(&output);
    assert_eq!(code, 3, "{error}");
    assert_contains(&error, &["not graded, and not the student's fault"]);
    let grades = class.read("grades.csv");
    assert!(grades.contains("ann,ann,,,,not graded,,,"), "{grades}");
    let score = class.out().join("students/ann/score.json");
    assert!(!score.exists(), "there must be no score");

    let text = successful_stdout(&grade_with_faults(1, &class, &exam));
    assert!(!text.contains("not graded"), "{text}");
    let grades = class.read("grades.csv");
    let points: Vec<&str> = grades.lines().nth(1).unwrap().split(',').collect();
    assert_eq!((points[5], points[6]), ("graded", points[7]), "{grades}");
}
