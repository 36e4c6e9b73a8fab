//! Clones of students' repositories that were packed into an archive. They are read like the folder
//! that was packed, or refused with what to do.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::harness::{
    TestClass, assert_contains, class_command, files_below, refusal, successful_stdout, zip,
};

/// Adds a repository as created by `git clone`.
fn with_clone(class: TestClass, path: &str) -> TestClass {
    class
        .with(&format!("{path}/.git/HEAD"), "ref: refs/heads/main")
        .with(&format!("{path}/.git/objects/pack/pack-1.pack"), "PACK")
        .with(&format!("{path}/.gitignore"), "target")
        .with_minimal_submission(&format!("{path}/student/src"))
}

fn class(name: &str, paths: &[&str]) -> TestClass {
    let class = TestClass::named(name);
    paths
        .iter()
        .fold(class, |class, path| with_clone(class, path))
}

/// Packs the class's folder in each way that people pack a folder: the folder or its contents, as a
/// zip or a tarball. Returns the archives, which are named after the folder.
fn packed(class: &TestClass) -> Vec<PathBuf> {
    let input = class.input();
    let mut archives = Vec::new();
    for (kind, base) in [
        ("folder", class.path_beside("")),
        ("contents", input.clone()),
    ] {
        let folder = class.path_beside(kind);
        fs::create_dir_all(&folder).unwrap();
        let inside = input.strip_prefix(&base).unwrap();
        let inside = if inside == Path::new("") {
            Path::new(".")
        } else {
            inside
        };
        let tarball = folder.join(format!("{}.tar.gz", class.name));
        let mut tar = Command::new("tar");
        tar.arg("-czf")
            .arg(&tarball)
            .arg("-C")
            .arg(&base)
            .arg(inside);
        assert!(tar.status().unwrap().success());
        let archive = folder.join(format!("{}.zip", class.name));
        let files = files_below(&input).into_iter().map(|path| {
            let name = path.strip_prefix(&base).unwrap().display().to_string();
            (name, fs::read(&path).unwrap())
        });
        fs::write(&archive, zip(files)).unwrap();
        archives.extend([tarball, archive]);
    }
    archives
}

/// Returns what a dry run prints, without the class's own path and the note about the folder.
fn outcome(class: &TestClass, input: &Path, options: &[&str]) -> String {
    let mut command = class_command();
    let output = command.arg(input).arg("--dry-run").args(options).output();
    let output = output.unwrap();
    let text = if output.status.success() {
        successful_stdout(&output)
    } else {
        refusal(&output)
    };
    let note = format!("\n  the submissions are in the folder {}\n", class.name);
    text.replace(&note, "")
}

#[test]
fn packed_clones_are_read_like_their_folder() {
    let classroom50 = class("2026-11-29", &["cg-pt-ann", "cg-pt-bob"])
        .with("cg-pt-ann/result.json", "{}")
        .with("cg-pt-bob/result.json", "{}")
        .with(
            "scores.csv",
            "username,first_name,last_name\nann,Ann,Lee\nbob,Bob,Kim\n",
        );
    let github = class("pt-submissions", &["pt-ann", "pt-bob"]);
    let flat = class("cg26", &["cg26-ann", "cg26-bob"]);
    let tutorials = class("cg26", &["mon/cg26-ann", "mon/cg26-bob", "tue/cg26-eve"]);
    let deep = class("cg26", &["mon/cg26-ann", "tue/cg26-bob"]).with("tue/notes.txt", "text");
    let gitlab = ["--layout", "gitlab"];
    let none: [&str; 0] = [];
    for (class, options, expected) in [
        (&classroom50, &none[..], "  Ann Lee: all"),
        (&github, &none[..], "  ann: all"),
        (&github, &["--layout", "github"][..], "  ann: all"),
        (&flat, &none[..], "pass --layout gitlab"),
        (&flat, &gitlab[..], "  ann: all"),
        (&tutorials, &none[..], "--layout tutorials"),
        (
            &tutorials,
            &gitlab[..],
            "3 submissions in clones of a GitLab group",
        ),
        (&deep, &gitlab[..], "tue/cg26-bob"),
    ] {
        let own = outcome(class, &class.input(), options);
        assert_contains(&own, &[expected]);
        for archive in packed(class) {
            let other = outcome(class, &archive, options);
            if own.starts_with("error") {
                assert_contains(&other, &["error", expected]);
            } else {
                assert_eq!(other, own, "{}", archive.display());
            }
        }
    }
}

/// Nothing says whether the folder is the class.
#[test]
fn packed_clones_in_an_archive_with_another_name_are_refused_unless_the_layout_is_chosen() {
    let class = class("pt-submissions", &["pt-ann", "pt-bob"]);
    for archive in packed(&class).into_iter().take(2) {
        let name = archive.file_name().unwrap().to_str().unwrap();
        let renamed = archive.with_file_name(name.replace("pt-submissions", "week 3"));
        fs::rename(&archive, &renamed).unwrap();
        let error = outcome(&class, &renamed, &[]);
        assert_contains(
            &error,
            &["the folder pt-submissions contains several submissions"],
        );
        let preview = outcome(&class, &renamed, &["--layout", "github"]);
        assert_contains(
            &preview,
            &["2 submissions in clones", "  ann: all", "  bob: all"],
        );
    }
}
