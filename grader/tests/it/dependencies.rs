//! Allowed dependencies between crates, checked with `cargo tree`.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use grader::handed_out::RAYS;

use crate::harness::workspace;

/// Returns all dependencies of packages in this format, direct and indirect, except
/// dev-dependencies.
fn tree(packages: &[&str], format: &str) -> String {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--prefix=none"])
        .args(["--edges=normal,build", "--no-default-features"])
        .args(packages.iter().flat_map(|package| ["--package", package]))
        .args(["--format", format])
        .current_dir(workspace())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).unwrap()
}

/// Returns the names of all dependencies of a package.
fn dependencies(package: &str) -> BTreeSet<String> {
    let text = tree(&[package], "{p}");
    let names = text
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    names
        .filter(|name| *name != package)
        .map(str::to_owned)
        .collect()
}

fn forbidden_dependencies(package: &str, forbidden: &[&str]) -> Vec<String> {
    let dependencies = dependencies(package);
    let found = forbidden
        .iter()
        .filter(|name| dependencies.contains(**name));
    found.map(|name| (*name).to_owned()).collect()
}

#[test]
fn the_grader_depends_only_on_the_protocol_of_the_student_crates() {
    assert!(dependencies("grader").contains("protocol"));
    assert_eq!(
        forbidden_dependencies("grader", &["framework", "student", "reference", "author"]),
        [""; 0]
    );
}

#[test]
fn judging_depends_on_no_process_or_terminal_crates() {
    assert!(dependencies("grader").contains("judging"));
    let ours = [
        "grader",
        "class",
        "framework",
        "student",
        "reference",
        "author",
    ];
    // Crates for processes, sandboxes and terminals.
    let machine = ["rustix", "landlock", "clap", "anstream", "tempfile"];
    assert_eq!(forbidden_dependencies("judging", &ours), [""; 0]);
    assert_eq!(forbidden_dependencies("judging", &machine), [""; 0]);
}

#[test]
fn the_author_crate_does_not_link_the_reference() {
    assert!(dependencies("author").contains("grader"));
    assert_eq!(
        forbidden_dependencies("author", &["framework", "student", "reference"]),
        [""; 0]
    );
}

#[test]
fn the_class_crate_depends_only_on_the_grader() {
    assert!(dependencies("class").contains("grader"));
    assert_eq!(
        forbidden_dependencies("class", &["framework", "student", "reference", "author"]),
        [""; 0]
    );
}

#[test]
fn the_viewer_is_no_dependency_and_links_no_solution() {
    assert!(dependencies("view").contains("framework"));
    for package in [
        "grader",
        "class",
        "author",
        "judging",
        "student",
        "framework",
    ] {
        assert_eq!(
            forbidden_dependencies(package, &["view", "view_probe"]),
            [""; 0]
        );
    }
    assert_eq!(
        forbidden_dependencies("view", &["student", "reference", "author", "class"]),
        [""; 0]
    );
    assert_eq!(
        forbidden_dependencies("view_probe", &["grader", "judging", "student", "reference"]),
        [""; 0]
    );
}

#[test]
fn student_crates_do_not_depend_on_the_grader() {
    for package in ["student", "framework", "protocol"] {
        assert_eq!(
            forbidden_dependencies(
                package,
                &["grader", "judging", "class", "reference", "author"]
            ),
            [""; 0]
        );
    }
    assert_eq!(forbidden_dependencies("protocol", &["framework"]), [""; 0]);
}

/// Checks that the features are equal. Otherwise, Cargo would compile these crates twice before the
/// first grade: once for the grader, and once for submissions. If this fails, correct the features in
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
fn starters_contain_no_solution_markers() {
    for file in RAYS.file_names() {
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
