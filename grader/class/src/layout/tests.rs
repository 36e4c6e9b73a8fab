//! How layouts are told apart; what each is read into is shown through the real binary.

use std::path::PathBuf;

use super::*;

fn file(name: &str) -> Node {
    Node {
        name: name.to_owned(),
        path: PathBuf::from(name),
        inside: None,
    }
}

fn folder(name: &str, inside: Vec<Node>) -> Node {
    Node {
        inside: Some(inside),
        ..file(name)
    }
}

fn layout(root: &Node) -> Layout {
    recognise(root, None).unwrap().layout
}

#[test]
fn a_wrapper_is_looked_through_and_a_submission_is_not() {
    let class = folder("class", vec![folder("ann", vec![]), folder("bob", vec![])]);
    let wrapped = folder("download", vec![class.clone()]);
    assert_eq!(unwrapped(&wrapped), &class);
    let one = folder("class", vec![folder("ann", vec![file("camera.rs")])]);
    assert_eq!(unwrapped(&one), &one);
    let moodle = folder(
        "class",
        vec![folder("Ann_1_assignsubmission_file_", vec![])],
    );
    assert_eq!(unwrapped(&moodle), &moodle);
}

#[test]
fn most_of_the_names_decide() {
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
fn ids_that_a_file_system_takes_for_one_get_numbers() {
    let names = ["Ann", "ann", "a/n"].map(|name| folder(name, vec![]));
    let found = recognise(&folder("x", names.to_vec()), None).unwrap();
    let ids: Vec<&str> = found
        .entries
        .iter()
        .map(|entry| entry.id.as_str())
        .collect();
    assert_eq!(ids, ["Ann", "a_n", "ann-2"]);
}
