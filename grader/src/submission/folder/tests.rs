use std::fs;
use std::io::ErrorKind;

use super::*;
use crate::handed_out::RAYS;
use crate::submission::Submission;
use crate::submission::tests::{Files, collected, exceeded, folder, tar, text, texts};

/// Returns the results of searching a folder with these files.
fn searched(files: Files) -> Search {
    search(folder(files).path(), &RAYS).unwrap()
}

#[test]
fn folders_are_searched_down_to_a_limit() {
    let path = |levels: usize| format!("{}bvh.rs", "a/".repeat(levels));
    assert_eq!(searched(&[(&path(12), b"new")]).candidates.len(), 1);
    let deeper = searched(&[(&path(13), b"new")]);
    assert!(deeper.candidates.is_empty());
    assert!(matches!(
        deeper.errors[..],
        [(_, SubmissionError::TooMany(_, Limit::Levels))]
    ));
    let deepest = collected(&[(&path(40), b"new")]);
    assert_eq!(exceeded(deepest), Some(Limit::Levels));
}

#[test]
fn files_are_counted_up_to_a_limit() {
    let three = folder(&[("a", b""), ("b", b""), ("c", b"")]);
    let visit = |left: usize| {
        let mut search = Search::new(three.path(), &RAYS);
        search.spend(Limit::Files, 50_000 - left).unwrap();
        let folder = Folder::open(three.path()).unwrap();
        search.visit(&folder, "")
    };
    assert_eq!(exceeded(visit(3)), None);
    assert_eq!(exceeded(visit(2)), Some(Limit::Files));
}

#[test]
fn a_file_that_is_too_long_costs_only_its_own_points() {
    let long = vec![b' '; 1 + (1 << 20)];
    let submission = collected(&[("bvh.rs", &long), ("sphere.rs", b"new")]).unwrap();
    assert_eq!(*text(&submission, "bvh.rs"), Err(TaskFileError::TooLong));
    assert_eq!(texts(&submission), [("sphere.rs", "new")]);
    assert_eq!(
        submission.notes, [""; 0],
        "there are no notes about task files"
    );
}

#[test]
fn only_faults_of_the_machine_stop_the_search() {
    let read = |kind: ErrorKind| read_file(Err(kind.into()));
    let denied = Err(TaskFileError::Unreadable("permission denied".to_owned()));
    assert_eq!(read(ErrorKind::PermissionDenied).unwrap(), denied);
    assert_eq!(
        read(ErrorKind::TimedOut).unwrap_err().kind(),
        ErrorKind::TimedOut
    );
    assert_eq!(read_file(Ok(None)).unwrap(), Err(TaskFileError::NotRegular));
    let unreadable = |kind: ErrorKind| unreadable("a".as_ref(), kind.into());
    assert!(!unreadable(ErrorKind::NotFound).is_machine_fault());
    assert!(unreadable(ErrorKind::TimedOut).is_machine_fault());
}

#[test]
fn archives_in_a_platforms_folder_or_among_single_files_are_read_like_folders() {
    let archive = tar(&[("src/bvh.rs", b"new")]);
    let folder = folder(&[
        ("work.tar", &archive),
        ("notes.txt", b"neither code nor an archive"),
        ("old.zip/readme", b"a folder"),
    ]);
    let submission = Submission::collect(folder.path(), &RAYS).unwrap();
    assert_eq!(texts(&submission), [("bvh.rs", "new")]);
    fs::rename(folder.path().join("work.tar"), folder.path().join("17.bin")).unwrap();
    let files = [("work.tar".to_owned(), folder.path().join("17.bin"))];
    let submission = Submission::from_files("ann", &files, &RAYS).unwrap();
    assert_eq!(texts(&submission), [("bvh.rs", "new")]);
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
fn a_single_folder_is_searched_without_those_below() {
    let folder = folder(&[("bvh.rs", b"new"), ("old/bvh.rs", b"old")]);
    let search = search_one(folder.path(), &RAYS).unwrap();
    assert_eq!(search.candidates.len(), 1);
}

/// Old programs unpack folders with names in their own encoding.
#[cfg(target_os = "linux")]
#[test]
fn folders_and_archives_whose_names_are_not_utf8_are_searched() {
    use std::os::unix::ffi::OsStrExt;

    let folder = folder(&[("notes.txt", b"")]);
    let named = |name: &[u8]| folder.path().join(OsStr::from_bytes(name));
    fs::create_dir(named(b"L\xf6sung")).unwrap();
    fs::write(named(b"L\xf6sung/bvh.rs"), b"new").unwrap();
    fs::write(named(b"L\xf6sung.tar"), tar(&[("bvh.rs", b"newer")])).unwrap();
    // This isn't a task file, so it is only mentioned.
    fs::write(named(b"b\xf6x.rs"), b"").unwrap();
    let error = Submission::collect(folder.path(), &RAYS).unwrap_err();
    let SubmissionError::Ambiguous { copies, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(copies, ["L\u{fffd}sung", "L\u{fffd}sung.tar"]);

    let search = search(folder.path(), &RAYS).unwrap();
    let names = "L\u{fffd}sung L\u{fffd}sung.tar b\u{fffd}x.rs notes.txt";
    assert_eq!(search.names.join(" "), names);
    assert_eq!(search.candidates[0].folder, "L\u{fffd}sung");
}
