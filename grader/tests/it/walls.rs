//! Who may touch whom: by what Cargo knows, not by asking.

use std::collections::BTreeSet;
use std::process::Command;

use crate::harness::workspace;

/// All that a package is built with, however far down. Without what only tests need.
fn dependencies(package: &str) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            "--offline",
            "--locked",
            "--prefix=none",
            "--format={p}",
        ])
        .args(["--edges=normal,build", "--package", package])
        .current_dir(workspace())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = String::from_utf8(output.stdout).unwrap();
    let names = text
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    names
        .filter(|name| *name != package)
        .map(str::to_owned)
        .collect()
}

fn meets(package: &str, forbidden: &[&str]) -> Vec<String> {
    let dependencies = dependencies(package);
    let met = forbidden
        .iter()
        .filter(|name| dependencies.contains(**name));
    met.map(|name| (*name).to_owned()).collect()
}

#[test]
fn the_grader_knows_the_protocol_and_nothing_else_of_the_students_side() {
    assert!(dependencies("grader").contains("protocol"));
    assert_eq!(
        meets("grader", &["framework", "student", "reference", "author"]),
        [""; 0]
    );
}

#[test]
fn what_judges_knows_nothing_of_who_asks() {
    assert!(dependencies("grader").contains("judging"));
    let ours = [
        "grader",
        "class",
        "framework",
        "student",
        "reference",
        "author",
    ];
    // What processes, sandboxes and terminals need.
    let machine = ["rustix", "landlock", "clap", "anstream", "tempfile"];
    assert_eq!(meets("judging", &ours), [""; 0]);
    assert_eq!(meets("judging", &machine), [""; 0]);
}

#[test]
fn the_author_never_links_the_reference() {
    assert!(dependencies("author").contains("grader"));
    assert_eq!(
        meets("author", &["framework", "student", "reference"]),
        [""; 0]
    );
}

#[test]
fn a_class_is_graded_by_the_grader_and_by_nothing_else_of_ours() {
    assert!(dependencies("class").contains("grader"));
    assert_eq!(
        meets("class", &["framework", "student", "reference", "author"]),
        [""; 0]
    );
}

#[test]
fn the_students_side_knows_nothing_of_the_grader() {
    for package in ["student", "framework", "protocol"] {
        assert_eq!(
            meets(
                package,
                &["grader", "judging", "class", "reference", "author"]
            ),
            [""; 0]
        );
    }
    assert_eq!(meets("protocol", &["framework"]), [""; 0]);
}

#[test]
fn what_students_get_inherits_nothing_from_the_workspace() {
    for package in ["student", "student/framework", "student/protocol"] {
        let manifest = workspace().join(package).join("Cargo.toml");
        let text = std::fs::read_to_string(manifest).unwrap();
        assert!(
            !text.contains("workspace") && !text.contains("[profile"),
            "{package}"
        );
    }
}

#[test]
fn no_mark_of_a_solution_is_handed_out() {
    for file in crate::harness::FIVE {
        for folder in ["student/src", "grader/starter"] {
            let path = workspace().join(folder).join(file);
            let text = std::fs::read_to_string(path).unwrap();
            assert!(
                !text.contains("solution") && !text.contains("// starter"),
                "{file}"
            );
        }
    }
}
