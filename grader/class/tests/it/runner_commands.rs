//! A CI system executes commands found in a log. Nothing a student chooses may become such a
//! command.

use std::process::{Command, Output};

use grader::printing::without_commands;

use crate::harness::{TestClass, class_command, zip};

/// One command of each kind, written so that the text is also a valid file name.
const COMMANDS: &str = "::error::a ##[set-env name=a]b ##vso[task.complete]c ##teamcity[d]";

/// Panics if a program prints none of the names, or prints one of them as a command.
fn check(command: &mut Command) {
    let Output { stdout, stderr, .. } = command.env("GITHUB_ACTIONS", "true").output().unwrap();
    let text = [stdout, stderr].map(|text| String::from_utf8(text).unwrap());
    let text = text.join("\n");
    assert_eq!(without_commands(&text), text, "{command:?}");
    assert!(text.contains("set-env"), "{command:?}: {text}");
}

#[test]
fn nothing_of_a_class_is_a_command_in_a_log() {
    let archive = zip([(format!("../{COMMANDS}"), "x")]);
    let hit = "pub fn hit(&self, ray: &Ray) -> Option<Trace> {";
    let class = TestClass::named(COMMANDS)
        .with("mallory.zip", archive)
        .with(COMMANDS, "")
        .with_reference(&format!("{COMMANDS} folder"))
        .with_reference("ann")
        .with_replaced(
            "ann/sphere.rs",
            hit,
            &format!("{hit} panic!(\"{COMMANDS}\");"),
        )
        .with("ann/camera.rs", format!("compile_error!(\"{COMMANDS}\");"))
        .with_folder("bob");
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    let rows = format!("ann,{COMMANDS}\n{COMMANDS},{COMMANDS}\n");
    let roster = class.write_beside("roster.csv", &format!("username,name\n{rows}"));
    let extensions = format!("[late.extensions]\n{COMMANDS:?} = 2\n");
    let policy = class.write_beside("policy.toml", &extensions);
    let lists = ["--roster", &*roster, "--policy", &*policy];

    check(
        class_command()
            .arg(class.input())
            .arg("--dry-run")
            .args(lists),
    );
    check(&mut class.command(&exam, &lists));
    check(&mut class.command(&exam, &[&lists[..], &["--regrade"]].concat()));
    let shards = ["1", "2"].map(|number| {
        let out = class.path_beside(&format!("{COMMANDS} {number}"));
        let mut part = class_command();
        part.arg(class.input()).args(["--exam", &exam]).args(lists);
        part.args(["--shard", &format!("{number}/2")]);
        check(part.arg("--out").arg(&out));
        out
    });
    let mut merge = class_command();
    merge.arg("merge").args(shards).args(lists);
    check(merge.arg("--out").arg(class.path_beside(COMMANDS)));
    check(&mut class.command(COMMANDS, &[]));
    for arguments in [
        ["--roster", COMMANDS],
        ["--manual-points", COMMANDS],
        ["--canvas", COMMANDS],
        ["--policy", COMMANDS],
        ["--shard", COMMANDS],
    ] {
        check(&mut class.command(&exam, &arguments));
    }
}
