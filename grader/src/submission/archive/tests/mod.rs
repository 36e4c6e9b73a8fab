//! Tests with regular archives, and helpers for all archive tests.

mod rejected;

use std::io::{Cursor, Write};

use flate2::Compression;
use flate2::write::GzEncoder;
use tar::{Builder, EntryType, Header};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::*;
use crate::handed_out::RAYS;
use crate::submission::tests::{self, Files, exceeded, folder, tar, text};
use crate::submission::{Limit, Submission, SubmissionError, TaskFileError};

fn zip(files: Files) -> Vec<u8> {
    tests::zip(files, CompressionMethod::Deflated)
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

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn collect(name: &str, bytes: &[u8]) -> Result<Submission, SubmissionError> {
    let folder = folder(&[(name, bytes)]);
    Submission::collect(&folder.path().join(name), &RAYS)
}

fn collect_error(bytes: &[u8]) -> ArchiveError {
    match collect("alice.zip", bytes) {
        Err(SubmissionError::Archive { why, .. }) => why,
        other => panic!("{other:?}"),
    }
}

/// Returns the listing of a class's archive.
fn listing(bytes: &[u8]) -> Listing {
    let folder = folder(&[("a.tar", bytes)]);
    let archive = Archive::open(&folder.path().join("a.tar"), ArchiveLimits::class());
    archive.unwrap().listing().unwrap()
}

/// Returns an archive of files with these names and identical contents.
fn packed(
    pack: fn(Files) -> Vec<u8>,
    names: impl Iterator<Item = String>,
    bytes: &[u8],
) -> Vec<u8> {
    let names: Vec<String> = names.collect();
    let files: Vec<_> = names.iter().map(|name| (name.as_str(), bytes)).collect();
    pack(&files)
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
        // The kind is determined by a file's bytes, not its extension.
        collect("alice.tgz", &zip(FILES)),
    ];
    for submission in all {
        let submission = submission.unwrap();
        assert_eq!(submission.name, "alice");
        assert_eq!(*text(&submission, "bvh.rs"), Ok("tree".to_owned()));
        assert_eq!(*text(&submission, "camera.rs"), Err(TaskFileError::Missing));
        let notes = [
            "helper.rs is not one of the task files and is ignored",
            "world.rs differs from the given file, which is used instead of yours",
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
        let listing = listing(bytes);
        let paths = listing.members.into_iter().map(|member| member.path);
        (
            paths.collect::<Vec<_>>(),
            listing.folders,
            listing.errors.len(),
        )
    };
    let none = Vec::<String>::new;
    let folder = vec!["a/b".to_owned()];
    let file = vec!["a/bvh.rs".to_owned()];
    let directory = tar_with("a/b/", EntryType::Directory, b"");
    assert_eq!(listing(&directory), (none(), folder, 0));
    for kind in [EntryType::Regular, EntryType::Continuous] {
        let regular = tar_with("a/bvh.rs", kind, b"x");
        assert_eq!(listing(&regular), (file.clone(), none(), 0));
    }
    // Git stores the commit's id in such a header.
    let comment = tar_with("pax_global_header", EntryType::XGlobalHeader, b"");
    assert_eq!(listing(&comment), (none(), none(), 0));
    // The folder of a link is listed, so that its student can be informed.
    let link = tar_with("ann/bvh.rs", EntryType::Symlink, b"");
    assert_eq!(listing(&link), (none(), vec!["ann".to_owned()], 1));
}

#[test]
fn a_file_as_long_as_the_limit_is_read_in_full() {
    const LIMIT: usize = 1 << 20;
    // A file that cannot be compressed takes more bytes in the archive than on its own.
    let long = vec![b'/'; LIMIT];
    let stored = tests::zip(&[("bvh.rs", &long)], CompressionMethod::Stored);
    for bytes in [stored, tar(&[("bvh.rs", &long)])] {
        let submission = collect("a", &bytes).unwrap();
        let text = text(&submission, "bvh.rs").as_deref();
        assert_eq!(text.map(str::len), Ok(LIMIT));
    }
    let longer = vec![b' '; LIMIT + 1];
    for bytes in [zip(&[("bvh.rs", &longer)]), tar(&[("bvh.rs", &longer)])] {
        let too_long = Err(TaskFileError::TooLong);
        assert_eq!(*text(&collect("a", &bytes).unwrap(), "bvh.rs"), too_long);
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
        let missing = Err(TaskFileError::Missing);
        assert_eq!(*text(&submission, "sphere.rs"), missing);
        assert_eq!(submission.notes, Vec::<String>::new());
    }
}

#[test]
fn the_folders_in_an_archive_are_named_with_it() {
    let inner = zip(&[("old/bvh.rs", b"2")]);
    let archive = tar(&[("bvh.rs", b"1"), ("more/inner.zip", &inner)]);
    let folder = folder(&[("a.tar", &archive)]);
    let error = Submission::collect(folder.path(), &RAYS).unwrap_err();
    let SubmissionError::Ambiguous { copies, .. } = error else {
        panic!("{error}");
    };
    assert_eq!(copies, ["a.tar", "a.tar/more/inner.zip/old"]);
}

#[test]
fn archives_in_archives_are_opened_down_to_a_level() {
    let nested = |levels: usize| {
        let work = zip(&[("src/bvh.rs", b"tree")]);
        (1..levels).fold(work, |inner, _| tar(&[("hw.zip", &inner)]))
    };
    let submission = collect("hw.zip", &nested(MAX_LEVELS)).unwrap();
    assert_eq!(*text(&submission, "bvh.rs"), Ok("tree".to_owned()));
    let refused = collect_error(&nested(MAX_LEVELS + 1));
    assert_eq!(refused, ArchiveError::TooDeep);
}

/// All archives in a submission share one budget, no matter how small each of them is.
#[test]
fn archives_share_one_budget() {
    let too_many = |archives: usize, archive: &[u8]| {
        let folder = folder(&[("bvh.rs", b"tree")]);
        for number in 0..archives {
            std::fs::write(folder.path().join(format!("{number}.zip")), archive).unwrap();
        }
        exceeded(Submission::collect(folder.path(), &RAYS))
    };
    let work = zip(&[("bvh.rs", b"tree")]);
    assert_eq!(too_many(31, &work), None);
    assert_eq!(too_many(33, &work), Some(Limit::Archives));
    // Unreadable archives and nested archives are counted too.
    assert_eq!(too_many(33, b"Rar!\x1a\x07"), Some(Limit::Archives));
    let ten = packed(zip, (0..10).map(|n| format!("{n}.zip")), &work);
    assert_eq!(too_many(3, &ten), Some(Limit::Archives));
    let files = packed(zip, (0..20_000).map(|n| format!("{n}.txt")), b"");
    assert_eq!(too_many(3, &files), Some(Limit::Files));
    let zeros = vec![0; 200 << 20];
    let large = gzip(&tar(&[("film.mp4", &zeros), ("bvh.rs", b"tree")]));
    assert_eq!(too_many(3, &large), Some(Limit::Bytes));
    assert_eq!(too_many(2, &large), None);
}

#[test]
fn task_files_and_copies_of_them_are_counted_up_to_a_limit() {
    let copies = packed(zip, (0..=200).map(|n| format!("{n}/my_bvh_{n}.rs")), b"x");
    assert_eq!(exceeded(collect("a.zip", &copies)), Some(Limit::Copies));
    for (folders, limit) in [(64, None), (65, Some(Limit::Folders))] {
        let archive = packed(zip, (0..folders).map(|n| format!("{n}/bvh.rs")), b"x");
        assert_eq!(exceeded(collect("a.zip", &archive)), limit);
    }
}
