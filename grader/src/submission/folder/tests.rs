use std::fs;
use std::io::ErrorKind;

use super::*;
use crate::handed_out::RAYS;
use crate::submission::Submission;
use crate::submission::tests::{Files, folder, tar, text, texts};

/// Returns the folders in which a search has found task files.
fn found(files: Files) -> Vec<String> {
    let folder = folder(files);
    let search = search(folder.path(), &RAYS).unwrap();
    let candidates = search.candidates.into_iter();
    candidates.map(|candidate| candidate.folder).collect()
}

#[test]
fn folders_of_tools_and_of_the_project_are_not_searched() {
    let files: [(&str, &[u8]); 4] = [
        ("src/bvh.rs", b"new"),
        ("target/bvh.rs", b""),
        ("grader/starter/bvh.rs", b""),
        (".git/bvh.rs", b""),
    ];
    assert_eq!(found(&files), ["src"]);
}

#[test]
fn folders_are_searched_down_to_a_limit() {
    let path = |levels: usize| format!("{}bvh.rs", "a/".repeat(levels));
    assert_eq!(found(&[(&path(MAX_DEPTH), b"new")]).len(), 1);
    let deeper = folder(&[(&path(MAX_DEPTH + 1), b"new")]);
    let search = search(deeper.path(), &RAYS).unwrap();
    assert!(search.candidates.is_empty());
    assert!(matches!(
        search.errors[..],
        [(_, SubmissionError::TooMany(_, Limit::Levels))]
    ));
}

#[test]
fn files_are_counted_up_to_a_limit() {
    let three = folder(&[("a", b""), ("b", b""), ("c", b"")]);
    let visit = |left: usize| {
        let mut search = Search::new(three.path());
        search.spend(Limit::Files, 50_000 - left).unwrap();
        let folder = Folder::open(three.path()).unwrap();
        search.visit(&folder, "", &RAYS)
    };
    assert!(visit(3).is_ok());
    let refused = visit(2);
    assert!(matches!(
        refused,
        Err(SubmissionError::TooMany(_, Limit::Files))
    ));
}

#[test]
fn a_file_that_is_too_long_costs_only_its_own_points() {
    let long = vec![b' '; 1 + (1 << 20)];
    let folder = folder(&[("bvh.rs", &long), ("sphere.rs", b"new")]);
    let submission = Submission::collect(folder.path(), &RAYS).unwrap();
    let too_long = Err(TaskFileError::TooLong("bvh.rs"));
    assert_eq!(*text(&submission, "bvh.rs"), too_long);
    assert_eq!(texts(&submission), [("sphere.rs", "new")]);
}

#[test]
fn only_faults_of_the_machine_stop_the_search() {
    let read = |kind: ErrorKind| read_file(Err(kind.into()), "bvh.rs");
    let name = "bvh.rs";
    let why = "permission denied".to_owned();
    let denied = Err(TaskFileError::Unreadable { name, why });
    assert_eq!(read(ErrorKind::PermissionDenied).unwrap(), denied);
    assert_eq!(
        read(ErrorKind::TimedOut).unwrap_err().kind(),
        ErrorKind::TimedOut
    );
    let not_regular = read_file(Ok(None), name).unwrap();
    assert_eq!(not_regular, Err(TaskFileError::NotRegular(name)));
    let unreadable = |kind: ErrorKind| unreadable("a".as_ref(), kind.into());
    assert!(!unreadable(ErrorKind::NotFound).is_machine_fault());
    assert!(unreadable(ErrorKind::TimedOut).is_machine_fault());
}

#[test]
fn archives_in_a_platforms_folder_are_read_like_folders() {
    let archive = tar(&[("src/bvh.rs", b"new")]);
    let folder = folder(&[
        ("work.tar", &archive),
        ("notes.txt", b"neither code nor an archive"),
        ("old.zip/readme", b"a folder"),
    ]);
    let submission = Submission::collect(folder.path(), &RAYS).unwrap();
    assert_eq!(texts(&submission), [("bvh.rs", "new")]);
}

#[test]
fn archives_among_single_files_are_read_like_folders() {
    let folder = folder(&[("17.bin", &tar(&[("src/bvh.rs", b"new")]))]);
    let files = [("work.tar".to_owned(), folder.path().join("17.bin"))];
    let submission = Submission::from_files("ann", &files, &RAYS).unwrap();
    assert_eq!(texts(&submission), [("bvh.rs", "new")]);
}

#[test]
fn nothing_is_noted_of_task_files() {
    let folder = folder(&[("bvh.rs", b"new"), ("sphere.rs", b"new")]);
    let submission = Submission::collect(folder.path(), &RAYS).unwrap();
    assert_eq!(submission.notes, [""; 0]);
}

#[test]
fn an_archive_that_cannot_be_read_could_have_what_is_missing() {
    let folder = folder(&[("bvh.rs", b"new"), ("rest.zip", b"PK\x03\x04")]);
    let refused = Submission::collect(folder.path(), &RAYS);
    assert!(matches!(refused, Err(SubmissionError::Archive { .. })));
}

#[cfg(unix)]
#[test]
fn archives_behind_links_are_not_read() {
    let elsewhere = folder(&[("work.tar", &tar(&[("bvh.rs", b"another's")]))]);
    let folder = folder(&[("sphere.rs", b"new")]);
    let link = folder.path().join("work.tar");
    system::symlink(&elsewhere.path().join("work.tar"), &link).unwrap();
    let submission = Submission::collect(folder.path(), &RAYS).unwrap();
    assert_eq!(texts(&submission), [("sphere.rs", "new")]);
}

#[test]
fn the_names_in_an_archive_without_task_files_are_listed() {
    let folder = folder(&[(
        "a.tar",
        &tar(&[("b/c.rs", b""), ("b/d", b""), ("a.txt", b"")]),
    )]);
    let error = Submission::collect(&folder.path().join("a.tar"), &RAYS).unwrap_err();
    assert!(error.to_string().ends_with("it has a.txt, b"), "{error}");
}

#[test]
fn a_single_folder_is_searched_without_those_below() {
    let folder = folder(&[("bvh.rs", b"new"), ("old/bvh.rs", b"old")]);
    let search = search_one(folder.path(), &RAYS).unwrap();
    assert_eq!(search.candidates.len(), 1);
    assert!(search.names.contains(&"bvh.rs".to_owned()));
}

/// Folders that an old program has unpacked have names in its encoding.
#[cfg(target_os = "linux")]
#[test]
fn folders_and_archives_whose_names_are_not_utf8_are_searched() {
    use std::os::unix::ffi::OsStrExt;

    let folder = folder(&[("notes.txt", b"")]);
    let named = |name: &[u8]| folder.path().join(OsStr::from_bytes(name));
    fs::create_dir(named(b"L\xf6sung")).unwrap();
    fs::write(named(b"L\xf6sung/bvh.rs"), b"new").unwrap();
    fs::write(named(b"L\xf6sung.tar"), tar(&[("bvh.rs", b"newer")])).unwrap();
    // It is no task file, and only named.
    fs::write(named(b"b\xf6x.rs"), b"").unwrap();
    let error = Submission::collect(folder.path(), &RAYS).unwrap_err();
    let SubmissionError::Ambiguous { copies, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(copies, ["L\u{fffd}sung", "L\u{fffd}sung.tar"]);

    let mut search = search(folder.path(), &RAYS).unwrap();
    search.names.sort();
    let names = [
        "b\u{fffd}x.rs",
        "L\u{fffd}sung",
        "L\u{fffd}sung.tar",
        "notes.txt",
    ];
    let mut names = names.map(str::to_owned);
    names.sort();
    assert_eq!(search.names, names);
    assert_eq!(search.candidates[0].folder, "L\u{fffd}sung");
}
