//! Tests with regular archives; helpers for all tests of archives.

mod rejected;

use std::io::{Cursor, Write};
use std::path::PathBuf;

use flate2::Compression;
use flate2::write::GzEncoder;
use tar::{Builder, EntryType, Header};
use tempfile::TempDir;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::*;
use crate::handed_out::RAYS;
use crate::submission::{Submission, SubmissionError, TaskFileError};

type Files<'a> = &'a [(&'a str, &'a [u8])];

fn zip(files: Files) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    for (path, bytes) in files {
        writer.start_file(*path, options).unwrap();
        writer.write_all(bytes).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// Returns a tar archive with one member, whose path is written unchanged. The `tar` crate's own
/// method rejects some paths.
fn tar_with(path: &str, kind: EntryType, bytes: &[u8]) -> Vec<u8> {
    let mut header = Header::new_ustar();
    header.as_ustar_mut().unwrap().name[..path.len()].copy_from_slice(path.as_bytes());
    header.set_entry_type(kind);
    header.set_size(bytes.len() as u64);
    header.set_mode(0o644);
    if kind == EntryType::Symlink || kind == EntryType::Link {
        header.set_link_name("/etc/passwd").unwrap();
    }
    header.set_cksum();
    let mut builder = Builder::new(Vec::new());
    builder.append(&header, bytes).unwrap();
    builder.into_inner().unwrap()
}

fn tar(files: Files) -> Vec<u8> {
    let mut builder = Builder::new(Vec::new());
    for (path, bytes) in files {
        let mut header = Header::new_gnu();
        header.set_size(bytes.len() as u64);
        header.set_mode(0o644);
        builder.append_data(&mut header, path, *bytes).unwrap();
    }
    builder.into_inner().unwrap()
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

struct TempArchive {
    _folder: TempDir,
    path: PathBuf,
}

fn write_archive(name: &str, bytes: &[u8]) -> TempArchive {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    TempArchive {
        _folder: folder,
        path,
    }
}

fn collect(name: &str, bytes: &[u8]) -> Result<Submission, SubmissionError> {
    Submission::collect(&write_archive(name, bytes).path, &RAYS)
}

fn collect_error(bytes: &[u8]) -> ArchiveError {
    match collect("alice.zip", bytes) {
        Err(SubmissionError::Archive { why, .. }) => why,
        other => panic!("{other:?}"),
    }
}

fn text<'a>(submission: &'a Submission, name: &str) -> &'a Result<String, TaskFileError> {
    let mut files = submission.files.iter();
    let (_, text) = files.find(|(file, _)| file.name == name).unwrap();
    text
}

const FILES: Files = &[
    ("hw-main/README.md", b"no"),
    ("hw-main/student/src/bvh.rs", b"tree"),
    ("hw-main/student/src/helper.rs", b""),
    ("hw-main/student/src/world.rs", b"mine"),
];

#[test]
fn reads_zip_tar_and_tar_gz_alike() {
    let all = [
        collect("alice.zip", &zip(FILES)),
        collect("alice.TAR", &tar(FILES)),
        collect("alice.tar.gz", &gzip(&tar(FILES))),
        // The bytes of a file decide, not its extension.
        collect("alice.tgz", &zip(FILES)),
    ];
    for submission in all {
        let submission = submission.unwrap();
        assert_eq!(submission.name, "alice");
        assert_eq!(*text(&submission, "bvh.rs"), Ok("tree".to_owned()));
        assert_eq!(
            *text(&submission, "camera.rs"),
            Err(TaskFileError::Missing("camera.rs"))
        );
        let notes = [
            "helper.rs is not one of the task files: ignored",
            "world.rs differs from the given file: the given one is used, not yours",
        ];
        assert_eq!(submission.notes, notes);
    }
}

#[test]
fn a_given_file_in_an_archive_is_noted_only_if_it_was_changed() {
    let library = RAYS.given_file("lib.rs").unwrap().text.as_bytes();
    let archive = zip(&[("src/bvh.rs", b"tree"), ("src/lib.rs", library)]);
    let submission = collect("a.zip", &archive).unwrap();
    assert_eq!(submission.notes, [""; 0]);
}

#[test]
fn accepts_windows_path_separators() {
    let submission = collect("a.zip", &zip(&[(r"alice\src\bvh.rs", b"tree")])).unwrap();
    assert_eq!(*text(&submission, "bvh.rs"), Ok("tree".to_owned()));
}

#[test]
fn recognises_archives_by_their_names_in_any_case() {
    for name in ["a.zip", "a.TAR.GZ", "a.rar", "a.7z"] {
        assert!(is_archive_name(name), "{name}");
    }
    for name in ["a.rs", "zip", "a.zip.txt"] {
        assert!(!is_archive_name(name), "{name}");
    }
}

#[test]
fn a_name_is_without_the_extension_of_an_archive() {
    let names = [
        "alice.tar.gz",
        "alice.b.ZIP",
        "alice.tgz",
        "alice.txt",
        ".zip",
    ];
    let stems = names.map(without_extension);
    assert_eq!(stems, ["alice", "alice.b", "alice", "alice.txt", ".zip"]);
}

#[test]
fn paths_are_relative_and_without_dots() {
    for (path, normalized) in [
        ("a/./b", "a/b"),
        (r"a\b", "a/b"),
        ("./a//b/", "a/b"),
        ("..a", "..a"),
    ] {
        assert_eq!(normalize_path(path), Ok(normalized.to_owned()));
    }
    for path in ["/a", "C:a", "..", "a/../b"] {
        let outside = ArchiveError::PathOutside(path.to_owned());
        assert_eq!(normalize_path(path), Err(outside));
    }
}

#[test]
fn lists_folders_and_only_regular_files() {
    let listing = |bytes: &[u8]| {
        let archive = write_archive("a.tar", bytes);
        let listing = Archive::open(&archive.path).unwrap().listing().unwrap();
        let paths: Vec<String> = listing
            .members
            .into_iter()
            .map(|member| member.path)
            .collect();
        (paths, listing.folders, listing.errors.len())
    };
    let none = Vec::<String>::new;
    let folder = vec!["a/b".to_owned()];
    let file = vec!["a/bvh.rs".to_owned()];
    let directory = tar_with("a/b/", EntryType::Directory, b"");
    assert_eq!(listing(&directory), (none(), folder, 0));
    for kind in [EntryType::Regular, EntryType::Continuous] {
        assert_eq!(
            listing(&tar_with("a/bvh.rs", kind, b"x")),
            (file.clone(), none(), 0)
        );
    }
    // Git stores the id of the commit in such a header.
    let comment = tar_with("pax_global_header", EntryType::XGlobalHeader, b"");
    assert_eq!(listing(&comment), (none(), none(), 0));
    // The folder of a link is listed, so that its person can be told.
    let link = tar_with("ann/bvh.rs", EntryType::Symlink, b"");
    assert_eq!(listing(&link), (none(), vec!["ann".to_owned()], 1));
}

#[test]
fn a_tar_is_read_at_once_and_a_zip_file_by_file() {
    let batch_size = |bytes: &[u8]| {
        let archive = write_archive("a", bytes);
        Archive::open(&archive.path).unwrap().batch_size()
    };
    assert_eq!(batch_size(&zip(FILES)), 1);
    assert_eq!(batch_size(&tar(FILES)), MAX_MEMBERS);
}

#[test]
fn a_file_as_long_as_the_limit_is_read_in_full() {
    const LIMIT: usize = 1 << 20;
    // A file that cannot be compressed takes more bytes in the archive than by itself.
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    let long = vec![b' '; LIMIT];
    writer.start_file("bvh.rs", options).unwrap();
    writer.write_all(&long).unwrap();
    let stored = writer.finish().unwrap().into_inner();
    for bytes in [stored, tar(&[("bvh.rs", &long)])] {
        let submission = collect("a", &bytes).unwrap();
        assert_eq!(
            text(&submission, "bvh.rs").as_ref().map(String::len),
            Ok(LIMIT)
        );
    }
    let longer = vec![b' '; LIMIT + 1];
    for bytes in [zip(&[("bvh.rs", &longer)]), tar(&[("bvh.rs", &longer)])] {
        let archive = write_archive("a", &bytes);
        let (found, _) = candidates(&archive.path, "", &RAYS).unwrap();
        let too_long = Err(TaskFileError::TooLong("bvh.rs"));
        assert_eq!(found[0].files.task_files["bvh.rs"], too_long);
    }
}

#[test]
fn only_rust_files_in_folders_that_are_handed_in_count() {
    let files: Files = &[
        ("hw/bvh.rs", b"tree"),
        ("hw/notes.txt", b"no"),
        ("hw/target/bvh.rs", b"another"),
        ("hw/.git/sphere.rs", b"another"),
    ];
    for bytes in [zip(files), tar(files)] {
        let submission = collect("a", &bytes).unwrap();
        assert_eq!(*text(&submission, "bvh.rs"), Ok("tree".to_owned()));
        let missing = Err(TaskFileError::Missing("sphere.rs"));
        assert_eq!(*text(&submission, "sphere.rs"), missing);
        assert_eq!(submission.notes, Vec::<String>::new());
    }
}

#[test]
fn the_folders_in_an_archive_are_named_with_it() {
    let archive = write_archive("a.zip", &zip(&[("bvh.rs", b"1"), ("old/bvh.rs", b"2")]));
    let (found, names) = candidates(&archive.path, "a.zip", &RAYS).unwrap();
    let folders: Vec<&str> = found
        .iter()
        .map(|candidate| candidate.folder.as_str())
        .collect();
    assert_eq!(folders, ["a.zip", "a.zip/old"]);
    assert_eq!(names, ["bvh.rs", "old"]);
}

#[test]
fn folders_with_task_files_are_counted_up_to_a_limit() {
    let count = |folders: usize| {
        let paths: Vec<String> = (0..folders).map(|n| format!("{n}/bvh.rs")).collect();
        let files: Vec<(&str, &[u8])> = paths
            .iter()
            .map(|path| (path.as_str(), &b"x"[..]))
            .collect();
        let archive = write_archive("a.zip", &zip(&files));
        candidates(&archive.path, "", &RAYS).map(|(found, _)| found.len())
    };
    assert_eq!(count(32).unwrap(), 32);
    let why = ArchiveError::TooManyFiles;
    assert!(matches!(count(33), Err(SubmissionError::Archive { why: found, .. }) if found == why));
}
