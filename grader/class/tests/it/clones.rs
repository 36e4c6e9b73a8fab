//! Clones of students' repositories: where the names begin in the folders' names, and folders for
//! tutorials. Clones that were packed into an archive are read like the folder that was packed, or
//! refused with what to do.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use insta::assert_snapshot;

use crate::harness::{
    TestClass, all_files, assert_contains, cell, class_command, files_below, refusal,
    successful_stdout, zip,
};

/// Adds a repository as created by `git clone`.
fn with_clone(class: TestClass, path: &str) -> TestClass {
    class
        .with(&format!("{path}/.git/HEAD"), "ref: refs/heads/main")
        .with(&format!("{path}/.git/objects/pack/pack-1.pack"), "PACK")
        .with(&format!("{path}/.gitignore"), "target")
        .with_minimal_submission(&format!("{path}/student/src"))
}

/// Returns a class of repositories.
fn class(name: &str, paths: &[impl AsRef<str>]) -> TestClass {
    let paths = paths.iter().map(AsRef::as_ref);
    paths.fold(TestClass::named(name), with_clone)
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

#[test]
fn reads_clones_of_a_gitlab_group_flat_and_with_tutorials() {
    let preview = |paths: &[&str]| {
        let class = class("cg26", paths).with("README.md", "text");
        // The layout isn't guessed.
        let error = class.refused_preview(&[]);
        assert_contains(&error, &["--layout folders"]);
        assert_eq!(
            error.contains("--layout gitlab or"),
            !paths[0].contains('/')
        );
        class.previewed(&["--layout", "gitlab"])
    };
    let flat = preview(&["cg26-ann", "cg26-bob"]);
    // The second tutorial has only one student.
    let tutorials = preview(&["mon/cg26-ann", "mon/cg26-bob", "tue/cg26-eve"]);
    assert_snapshot!(format!("{flat}\n\n{tutorials}"));
}

/// A single clone of another assignment or of a staff project doesn't change where the account name
/// begins in the other clones' names.
#[test]
fn the_accounts_on_a_list_show_where_the_names_of_clones_begin() {
    let scores = "username,first_name,last_name,email,datetime,late\n\
                  tum-ann,Ann,Lee,a@x.edu,,\ntum-bob,Bob,Kim,b@x.edu,,\ntum-eve,Eve,Ray,e@x.edu,,\n";
    let clones = ["ann", "bob", "eve"].map(|name| format!("cg26-pathtracing-tum-{name}"));
    let cloned = class("2026-11-29", &clones).with("scores.csv", scores);
    let people = ["  Ann Lee: all", "  Bob Kim: all", "  Eve Ray: all"];
    assert_contains(&cloned.preview(), &people);
    let preview = with_clone(cloned, "cg26-warmup-lena").preview();
    assert_contains(&preview, &people);
    let odd = "begin with cg26-pathtracing-, unlike cg26-warmup-lena: ";
    assert_contains(&preview, &[odd, &all_files("  cg26-warmup-lena")]);

    let class = with_clone(class("clones", &clones), "handout");
    let error = class.refused_preview(&["--layout", "gitlab"]);
    let odd = "begin with cg26-pathtracing-tum-, unlike handout, so it is unclear";
    assert_contains(
        &error,
        &[odd, "move them elsewhere; otherwise, pass a list"],
    );
    let roster = ("roster", "name,sid\nAnn,tum-ann\nBob,tum-bob\n");
    let preview = class.previewed_with(&[roster], &["--layout", "gitlab"]);
    assert_contains(&preview, &["  Ann: all", "  Bob: all", "  tum-eve: all"]);
}

#[test]
fn the_folder_above_a_gitlab_group_is_refused_with_the_one_to_pass() {
    let group = |paths: &[&str]| {
        let paths = paths.iter().map(|path| format!("cg26/{path}"));
        class("clones", &Vec::from_iter(paths))
    };
    let chosen = ["--layout", "gitlab"];
    let class = group(&["mon/pt-ann", "mon/pt-bob", "tue/pt-eve"]);
    let error = class.refused_preview(&chosen);
    assert_snapshot!(error, @"error: the folder cg26 contains folders with several projects (mon, tue), and each of these folders would be graded as one submission: pass the path of the folder cg26 (if it is in an archive, unpack the archive first)");
    let preview = class.preview_of(&class.input().join("cg26"), &chosen);
    assert_contains(&preview, &["3 submissions", "  ann: all", "  eve: all"]);
    assert_contains(&class.refused_preview(&[]), &["pass this folder"]);

    let class = group(&["pt-ann", "pt-bob"]);
    let preview = class.previewed(&chosen);
    assert_contains(&preview, &["2 submissions", "  ann: all", "  bob: all"]);
    assert!(!preview.contains("there is only"), "{preview}");

    // Each student has a subgroup.
    let class = group(&["ann/pt", "bob/pt"]);
    let error = class.refused_preview(&chosen);
    assert_contains(&error, &["pass the path of the folder cg26"]);
    let preview = class.preview_of(&class.input().join("cg26"), &chosen);
    assert_contains(&preview, &["2 submissions", "  ann: all", "  bob: all"]);
}

#[test]
fn a_folder_for_each_tutorial_is_refused_with_both_readings() {
    let class = TestClass::named("class")
        .with_minimal_submission("mon/ann")
        .with_minimal_submission("mon/bob")
        .with_minimal_submission("tue/eve")
        .with_minimal_submission("tue/zoe");
    let error = class.refused_preview(&[]);
    let error = error.replace(class.path_beside("").to_str().unwrap(), "FOLDER/");
    assert_snapshot!(error, @"error: FOLDER/class cannot be read as a class: the folder mon contains several submissions (ann, bob): if they are from different students, pass this folder, or move them out of it; if they are attempts by one student, keep only the one that should be graded; if each contains part of one submission, combine them in one folder. Alternatively, pass --layout tutorials if each folder contains several students' folders, --layout teams if the folders are from Microsoft Teams, or --layout folders if each folder is one submission");
    let preview = class.previewed(&["--layout", "tutorials"]);
    assert_contains(
        &preview,
        &["4 submissions", "mon/ann", "4 of 4 can be graded"],
    );
    let preview = class.previewed(&["--layout", "folders"]);
    assert_contains(
        &preview,
        &["2 submissions in folders and archives", "  mon: "],
    );
}

/// Two people have one account name, or somebody has two projects. Which one should be graded is
/// never chosen silently.
#[test]
fn projects_with_one_name_in_several_groups_are_left_to_staff() {
    for [first, second] in [["mon/pt-ann", "tue/pt-ann"], ["pt-ann", "tue/pt-ann"]] {
        let class = [first, second, "tue/pt-bob"]
            .iter()
            .fold(TestClass::named("cg26"), |class, path| {
                class.with(&format!("{path}/.git/HEAD"), "ref: refs/heads/main")
            })
            .with_reference(&format!("{first}/src"))
            .with_starter(&format!("{second}/src"))
            .with_reference("tue/pt-bob/src");
        let exam = class.small_exam(&["camera.offset"]);
        let text = class.graded(&exam, &["--layout", "gitlab", "--hand-back"]);
        let problem = format!(
            "there are several folders with this name ({first}, {second}): keep only the one that \
             should be graded, or rename the folders if they are by different people"
        );
        assert_contains(&text, &["1 graded", "1 with nothing to grade", &problem]);
        let row = |id: &str| ["status", "points"].map(|column| cell(&class, id, id, column));
        assert_eq!(row("ann"), ["nothing to grade", ""]);
        assert_eq!(row("bob"), ["graded", "2"]);
        assert_contains(&class.read("class.html"), &[&problem]);
        // The students can't fix this.
        assert!(!class.out().join("hand-in-again").exists());

        let folder = |path: &str| class.input().join(path);
        fs::rename(folder(second), folder("tue/pt-ann.ray")).unwrap();
        let text = class.graded(&exam, &[]);
        assert_contains(&text, &["3 graded"]);
        let points = ["ann", "ann.ray"].map(|id| cell(&class, id, id, "points"));
        assert_eq!(points, ["2", "0"]);
    }
}
