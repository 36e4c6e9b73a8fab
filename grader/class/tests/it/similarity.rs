//! The input for similarity checkers and the list of identical submissions.

use std::fs;
use std::path::Path;
use std::process::Output;

use grader::handed_out::RAYS;

use crate::harness::{
    TestClass, assert_contains, class_command, files_below, refusal, successful_stdout,
};

fn run(class: &TestClass, folder: &Path, more: &[&str]) -> Output {
    let mut command = class_command();
    command.arg(class.input()).arg("--dry-run");
    command.arg("--similarity-input").arg(folder).args(more);
    command.output().unwrap()
}

#[test]
fn writes_numbered_own_lines_and_names_identical_submissions_beside_them() {
    let class = TestClass::named("class")
        .with_reference("ann lee")
        .with_reference("bob")
        // Comments and spaces don't make a difference.
        .with_replaced("bob/sphere.rs", "use glam", "// Bob O'Hara\n\nuse glam")
        // A byte order mark, which some editors add, doesn't make a difference either.
        .with_byte_order_mark("bob/camera.rs")
        .with_reference("carl")
        .with_replaced(
            "carl/sphere.rs",
            "use glam",
            "const MINE: f32 = 1.0;\nuse glam",
        )
        .with_starter("dora")
        .with_starter("eve")
        .with_folder("empty")
        .with_reference("z1")
        .with_replaced("z1/bvh.rs", "use glam", "const Z: f32 = 1.0;\nuse glam")
        .with_reference("z2")
        .with_replaced("z2/bvh.rs", "use glam", "const Z: f32 = 1.0;\nuse glam");
    let roster = "name,username,group\nZoë,z1,One\nZed,z2,One\n";
    let roster = class.write_beside("roster.csv", roster);
    let folder = class.path_beside("own");
    let text = successful_stdout(&run(&class, &folder, &["--roster", &roster]));
    let expected = [
        "  identical: ann_lee, bob\n",
        "  identical (same group): z1, z2\n",
    ];
    assert_contains(&text, &expected);
    // Students who wrote nothing are identical too, but that isn't worth reporting.
    assert!(!text.contains("identical: dora"), "{text}");

    let written = files_below(&folder);
    assert_eq!(written.len(), 5 * RAYS.files.len(), "{written:?}");
    for path in &written {
        let (path, text) = (path.to_str().unwrap(), fs::read_to_string(path).unwrap());
        for name in ["ann", "bob", "carl", "Zo", "Zed"] {
            assert!(!path[path.find("own").unwrap()..].contains(name), "{path}");
            assert!(!text.contains(name), "{path}");
        }
        assert!(
            !text.contains("//") && !text.contains("pub struct"),
            "{text}"
        );
    }
    let key = fs::read_to_string(class.path_beside("own-key.csv")).unwrap();
    assert!(key.contains(",ann_lee,ann lee\n"), "{key}");
    let carl = key.lines().find(|line| line.ends_with(",carl,carl"));
    let number = carl.unwrap().split(',').next().unwrap();
    let carl = fs::read_to_string(folder.join(format!("sphere/{number}.rs"))).unwrap();
    assert!(carl.contains("MINE"), "{carl}");
    let list = fs::read_to_string(class.path_beside("own-identical.csv")).unwrap();
    assert!(list.contains("2,z1,Zoë,same group\n"), "{list}");
}

#[test]
fn the_folder_must_be_empty_and_apart_from_input_and_output() {
    let class = TestClass::named("class").with_reference("ann");
    let (inside, out) = ("must not contain each other", class.out());
    for (folder, more, why) in [
        (class.input().join("own"), vec![], inside),
        (class.path_beside("."), vec![], "is not empty"),
        (
            out.join("own"),
            vec!["--out", out.to_str().unwrap()],
            inside,
        ),
    ] {
        assert_contains(&refusal(&run(&class, &folder, &more)), &[why]);
    }
    assert!(!out.exists());
}
