//! Allowed dependencies between crates, checked with `cargo tree`.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use crate::harness::workspace;

/// Returns all direct and indirect dependencies of packages, except dev-dependencies, each printed
/// in this format.
fn tree(packages: &[&str], format: &str) -> String {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--prefix=none"])
        .args(["--edges=normal,build", "--no-default-features"])
        .args(packages.iter().flat_map(|package| ["--package", package]))
        .args(["--format", format])
        .current_dir(workspace())
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// Returns the names of all dependencies of a package.
fn dependencies(package: &str) -> BTreeSet<String> {
    let text = tree(&[package], "{p}");
    let lines = text.lines();
    let names = lines.filter_map(|line| line.split_whitespace().next());
    let others = names.filter(|name| *name != package);
    others.map(str::to_owned).collect()
}

/// The packages, each with a dependency it must have and dependencies it must not have.
const RULES: [(&str, &str, &str); 11] = [
    // The protocol is the only one of the students' crates that the grader links.
    (
        "grader",
        "protocol",
        "framework student reference author view",
    ),
    // Nothing in this crate knows about processes, sandboxes or terminals.
    (
        "judging",
        "protocol",
        "grader class framework student reference author view rustix landlock clap anstream tempfile",
    ),
    ("author", "grader", "framework student reference view"),
    ("class", "grader", "framework student reference author view"),
    ("view", "framework", "student reference author class"),
    (
        "view_probe",
        "framework",
        "grader judging student light reference",
    ),
    ("student", "framework", OF_STAFF),
    // Without the command that renders pictures, part two doesn't need part one.
    (
        "light",
        "framework",
        "student grader judging class reference author view view_probe",
    ),
    ("reference-light", "framework", "reference student"),
    ("framework", "protocol", OF_STAFF),
    ("protocol", "glam", OF_STAFF),
];
const OF_STAFF: &str = "grader judging class reference author view view_probe";

#[test]
fn each_package_depends_only_on_what_it_may() {
    for (package, needed, forbidden) in RULES {
        let found = dependencies(package);
        assert!(found.contains(needed), "{package} uses {needed}");
        let forbidden = forbidden.split(' ');
        let forbidden: Vec<&str> = forbidden.filter(|name| found.contains(*name)).collect();
        assert_eq!(forbidden, [""; 0], "{package}");
    }
    assert!(!dependencies("protocol").contains("framework"));
}

/// Checks that crates used by both the grader and submissions are built with the same features.
/// Otherwise, Cargo would compile these crates twice before the first grade: once for the grader,
/// and once for submissions. If this fails, correct the features in
/// `grader/workspace-hack/Cargo.toml`.
#[test]
fn crates_shared_with_submissions_have_the_same_features() {
    let of = |packages: &[&str]| -> BTreeMap<String, String> {
        let text = tree(packages, "{p}|{f}");
        let lines = text.lines().filter_map(|line| line.split_once('|'));
        lines
            .map(|(package, features)| (package.to_owned(), features.replace(" (*)", "")))
            .collect()
    };
    let (grader, framework) = (of(&["grader"]), of(&["framework", "workspace-hack"]));
    let shared = framework.iter().filter_map(|(package, features)| {
        let graders = grader.get(package)?;
        Some((package, graders, features))
    });
    let shared: Vec<_> = shared.collect();
    assert!(shared.len() > 10, "{shared:?}");
    for (package, of_grader, of_framework) in shared {
        assert_eq!(of_grader, of_framework, "{package}");
    }
}

#[test]
fn student_manifests_inherit_nothing_from_the_workspace() {
    for package in [
        "student",
        "student/framework",
        "student/light",
        "student/protocol",
    ] {
        let manifest = workspace().join(package).join("Cargo.toml");
        let text = std::fs::read_to_string(manifest).unwrap();
        let inherits = text.contains("workspace") || text.contains("[profile");
        assert!(!inherits, "{package}");
    }
}
