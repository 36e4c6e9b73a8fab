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

fn layout(root: &Node) -> Layout {
    recognise(root, None, &RAYS).unwrap().layout
}

#[test]
fn skips_wrapper_folders_but_not_submissions() {
    let class = folder("class", vec![folder("ann", vec![]), folder("bob", vec![])]);
    let wrapped = folder("download", vec![class.clone()]);
    assert_eq!(find_class_folder(&wrapped, &RAYS), &class);
    let one = folder("class", vec![folder("ann", vec![file("camera.rs")])]);
    assert_eq!(find_class_folder(&one, &RAYS), &one);
    let moodle = folder(
        "class",
        vec![folder("Ann_1_assignsubmission_file_", vec![])],
    );
    assert_eq!(find_class_folder(&moodle, &RAYS), &moodle);
}

#[test]
fn the_majority_of_names_decides_the_layout() {
    let canvas = ["doe_1_2_a.zip", "lee_3_4_b.zip", "readme.txt"].map(file);
    assert_eq!(layout(&folder("x", canvas.to_vec())), Layout::Canvas);
    let plain = ["doe.zip", "lee_3_4_b.zip"].map(file);
    assert_eq!(layout(&folder("x", plain.to_vec())), Layout::Plain);
    let repositories = vec![folder("hw-ann", vec![]), folder("hw-bob", vec![])];
    assert_eq!(
        layout(&folder("hw-submissions", repositories.clone())),
        Layout::GitHub
    );
    assert_eq!(layout(&folder("hw", repositories)), Layout::Plain);
}

#[test]
fn ids_that_differ_only_in_case_get_numbers() {
    let names = ["Ann", "ann", "a/n"].map(|name| folder(name, vec![]));
    let found = recognise(&folder("x", names.to_vec()), None, &RAYS).unwrap();
    let ids: Vec<&str> = found
        .entries
        .iter()
        .map(|entry| entry.id.as_str())
        .collect();
    assert_eq!(ids, ["Ann", "a_n", "ann-2"]);
}
