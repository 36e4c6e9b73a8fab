//! Tests that layouts are recognised. The entries of each layout are tested by running the binary,
//! in `tests/it/layouts.rs`.

use std::path::PathBuf;

use grader::handed_out::RAYS;

use super::*;

fn file(name: &str) -> Node {
    Node {
        name: name.to_owned(),
        path: PathBuf::from(name),
        children: None,
        is_link: false,
    }
}

fn folder(name: &str, inside: Vec<Node>) -> Node {
    Node {
        children: Some(inside),
        ..file(name)
    }
}

fn recognised(root: &Node) -> RecognisedClass {
    recognise(&LayoutChoice::default(), root, None, &RAYS, &[]).unwrap()
}

fn layout(root: &Node) -> Layout {
    recognised(root).layout
}

/// A student can choose everything in a folder, and sometimes the folder's name. The archive's name
/// is chosen by the teacher.
#[test]
fn a_folder_that_is_alone_is_entered_by_its_name_and_not_by_its_contents() {
    let alone = |name: &str| {
        let inside = ["ann", "bob", METADATA].map(file).to_vec();
        folder("download", vec![folder(name, inside)])
    };
    let entered = |name: &str, archive: Option<&str>| {
        let root = alone(name);
        let (found, note) = find_class_folder(&root, archive);
        assert!(note.unwrap().contains(name));
        found.name == name
    };
    for (name, archive, is_entered) in [
        ("assignment_55_export", None, true),
        (
            "Path Tracer",
            Some("Path Tracer-20261127T112400Z-001.zip"),
            true,
        ),
        ("hw-submissions", Some("hw_submissions (1).tar.gz"), true),
        ("mallory", None, false),
        ("mallory", Some("in.zip"), false),
        ("ann", Some("anna.zip"), false),
    ] {
        assert_eq!(entered(name, archive), is_entered, "{name} {archive:?}");
    }
    let several = folder("x", vec![folder("ann", vec![]), folder("bob", vec![])]);
    assert_eq!(find_class_folder(&several, None), (&several, None));
}

/// Returns the number of the folder's entries that aren't graded because they seem to belong to
/// several people.
fn mixtures(root: &Node) -> usize {
    recognised(root).mixtures.len()
}

#[test]
fn folders_of_several_people_are_recognised() {
    let student = |name: &str, file_name: &str| {
        let src = folder("src", vec![file(file_name)]);
        folder(name, vec![folder("student", vec![src])])
    };
    let tutorial = |name: &str| folder(name, ["ann", "bob"].map(|n| student(n, "bvh.rs")).to_vec());
    let class = |entries: Vec<Node>| folder("class", entries);
    assert_eq!(mixtures(&class(vec![tutorial("mon"), tutorial("tue")])), 2);
    let wrapped = folder("export", vec![tutorial("mon")]);
    assert_eq!(mixtures(&class(vec![wrapped, student("eve", "bvh.rs")])), 1);
    let archives = ["ann.zip", "bob.zip"].map(file).to_vec();
    assert_eq!(mixtures(&class(vec![folder("mon", archives)])), 1);
    let flat = |names: &[&str]| class(vec![folder("x", names.iter().map(|n| file(n)).collect())]);
    assert_eq!(
        mixtures(&flat(&["bvh.rs", "bvh(1).rs", "camera.rs", "camera(1).rs"])),
        1
    );
    assert_eq!(mixtures(&flat(&["bvh.rs", "bvh (1).rs", "bvh (2).rs"])), 1);
    // One person's copy, and one person's entire project.
    assert_eq!(mixtures(&flat(&["bvh.rs", "bvh (1).rs", "camera.rs"])), 0);
    let mut project = student("eve", "bvh.rs");
    let given = folder("framework", vec![file("camera.rs")]);
    project
        .children
        .as_mut()
        .unwrap()
        .extend([given, student("old", "bvh.rs")]);
    assert_eq!(mixtures(&class(vec![project])), 0);
}

#[test]
fn the_majority_of_names_decides_the_layout() {
    let files = |names: &[&str]| folder("x", names.iter().map(|name| file(name)).collect());
    let canvas = files(&["doe_1_2_a.zip", "lee_3_4_b.zip", "readme.txt"]);
    assert_eq!(layout(&canvas), Layout::Canvas);
    for plain in [
        // In each of these pairs, both files have the same user, name or attachment.
        ["hw_1_20_jdoe.zip", "hw_1_21_mkim.zip"],
        ["hw_1_20_jdoe.zip", "hw_2_21_mkim.zip"],
        ["CS_148_3_jdoe.rs", "CS_148_3_mkim.rs"],
        ["2026_11_20_jdoe.zip", "2026_11_21_mkim.zip"],
        ["doe.zip", "lee_3_4_b.zip"],
    ] {
        assert_eq!(layout(&files(&plain)), Layout::Plain, "{plain:?}");
    }
    let clones = |name: &str| {
        folder(
            name,
            ["hw-ann", "hw-bob"]
                .map(|name| folder(name, vec![]))
                .to_vec(),
        )
    };
    assert_eq!(layout(&clones("hw-submissions")), Layout::GitHub);
    assert_eq!(layout(&clones("hw")), Layout::Plain);
}

#[test]
fn ids_that_differ_only_in_case_get_numbers() {
    let names = ["Ann", "ann", "a/n", "Jose\u{301}", "José"].map(|name| folder(name, vec![]));
    let found = recognised(&folder("x", names.to_vec()));
    let ids: Vec<&str> = found
        .entries
        .iter()
        .map(|entry| entry.id.as_str())
        .collect();
    assert_eq!(ids, ["Ann", "José", "José-2", "a_n", "ann-2"]);
}
