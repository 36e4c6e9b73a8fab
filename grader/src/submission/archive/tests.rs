//! What anybody may have made.

use std::io::{Cursor, Write};
use std::path::PathBuf;

use flate2::Compression;
use flate2::write::GzEncoder;
use tar::{Builder, EntryType, Header};
use tempfile::TempDir;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::*;
use crate::submission::Submission;

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

/// Paths are written as they are, which the crate's own way would refuse.
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

struct Kept {
    _folder: TempDir,
    path: PathBuf,
}

fn kept(name: &str, bytes: &[u8]) -> Kept {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    Kept {
        _folder: folder,
        path,
    }
}

fn collected(name: &str, bytes: &[u8]) -> Result<Submission, NoSubmission> {
    Submission::collect(&kept(name, bytes).path)
}

fn refused(bytes: &[u8]) -> Refused {
    match collected("alice.zip", bytes) {
        Err(NoSubmission::Refused { why, .. }) => why,
        other => panic!("{other:?}"),
    }
}

fn text<'a>(submission: &'a Submission, name: &str) -> &'a Result<String, Unreadable> {
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
fn a_zip_a_tar_and_a_compressed_tar_are_one_submission() {
    let all = [
        collected("alice.zip", &zip(FILES)),
        collected("alice.TAR", &tar(FILES)),
        collected("alice.tar.gz", &gzip(&tar(FILES))),
        // What it is, its bytes say.
        collected("alice.tgz", &zip(FILES)),
    ];
    for submission in all {
        let submission = submission.unwrap();
        assert_eq!(submission.name, "alice");
        assert_eq!(*text(&submission, "bvh.rs"), Ok("tree".to_owned()));
        assert_eq!(
            *text(&submission, "camera.rs"),
            Err(Unreadable::Missing("camera.rs"))
        );
        let notes = [
            "helper.rs is not one of the five files: ignored",
            "world.rs differs from the given one, which is used",
        ];
        assert_eq!(submission.notes, notes);
    }
}

#[test]
fn separators_of_windows_are_separators() {
    let submission = collected("a.zip", &zip(&[(r"alice\src\bvh.rs", b"tree")])).unwrap();
    assert_eq!(*text(&submission, "bvh.rs"), Ok("tree".to_owned()));
}

#[test]
fn a_path_that_leads_outside_is_refused_and_named_harmlessly() {
    for path in [
        "../bvh.rs",
        "/bvh.rs",
        "a/../../bvh.rs",
        r"..\bvh.rs",
        "C:bvh.rs",
    ] {
        let shown = path.replace('\\', "/");
        assert_eq!(
            refused(&zip(&[(path, b"")])),
            Refused::Outside(shown.clone())
        );
        let tarred = tar_with(path, EntryType::Regular, b"");
        assert_eq!(refused(&tarred), Refused::Outside(shown));
    }
    let odd = refused(&zip(&[("../\u{1b}[2J\n\u{202e}x", b"")]));
    assert_eq!(odd, Refused::Outside(r"../\u{1b}[2J\n\u{202e}x".to_owned()));
}

#[test]
fn a_link_or_a_device_is_refused_but_where_cargo_makes_links() {
    let kinds = [
        EntryType::Symlink,
        EntryType::Link,
        EntryType::Char,
        EntryType::Block,
        EntryType::Fifo,
    ];
    for kind in kinds {
        let why = Refused::Special("bvh.rs".to_owned());
        assert_eq!(refused(&tar_with("bvh.rs", kind, b"")), why);
    }
    let built = kept(
        "a.tar",
        &tar_with("hw/target/debug/hw", EntryType::Link, b""),
    );
    assert_eq!(
        Archive::open(&built.path).unwrap().members(),
        Ok(Vec::new())
    );

    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    writer
        .add_symlink("bvh.rs", "/etc/passwd", options)
        .unwrap();
    let zip = writer.finish().unwrap().into_inner();
    assert_eq!(refused(&zip), Refused::Special("bvh.rs".to_owned()));
}

#[test]
fn what_is_no_archive_is_told_by_what_it_is() {
    assert_eq!(refused(b""), Refused::Empty);
    assert_eq!(refused(&zip(&[])), Refused::Empty);
    assert_eq!(refused(&[0; 1024]), Refused::Empty);
    assert_eq!(refused(b"Rar!\x1a\x07\x01\x00"), Refused::OtherKind(".rar"));
    assert_eq!(
        refused(b"7z\xbc\xaf\x27\x1c\x00\x04"),
        Refused::OtherKind(".7z")
    );
    assert_eq!(refused(b"%PDF-1.7"), Refused::NotAnArchive);
    assert_eq!(refused(&gzip(b"pub struct Sphere")), Refused::NotAnArchive);
    assert!(matches!(
        collected("a.zip", &zip(&[("a/b/c/d.rs", b"")])),
        Err(NoSubmission::NoneOfFive(_))
    ));
    assert!(matches!(
        collected("a.zip", &zip(&[("a/bvh.rs", b""), ("b/bvh.rs", b"")])),
        Err(NoSubmission::Several { .. })
    ));
}

#[test]
fn wherever_an_archive_is_cut_it_is_damaged_or_lacks_files_and_nothing_worse() {
    for whole in [zip(FILES), tar(FILES), gzip(&tar(FILES))] {
        for length in (0..whole.len()).step_by(7) {
            match collected("a", &whole[..length]) {
                Ok(submission) => assert_eq!(submission.files.len(), 5),
                Err(NoSubmission::Refused { .. } | NoSubmission::NoneOfFive(_)) => {}
                Err(other) => panic!("{length}: {other}"),
            }
        }
    }
    assert!(matches!(refused(&zip(FILES)[..200]), Refused::Damaged(_)));
}

#[test]
fn a_bomb_goes_off_in_none_of_them() {
    let zeros = vec![0; 64 << 20];
    let files: Files = &[("bvh.rs", &zeros), ("sphere.rs", b"fine")];
    for bomb in [zip(files), gzip(&tar(files))] {
        let submission = collected("bomb", &bomb).unwrap();
        assert_eq!(
            *text(&submission, "bvh.rs"),
            Err(Unreadable::TooLong("bvh.rs"))
        );
        assert_eq!(*text(&submission, "sphere.rs"), Ok("fine".to_owned()));
    }
    // Of members that nobody wants, a tar inflates all the same.
    let many: Vec<(&str, &[u8])> = vec![("film.mp4", zeros.as_slice()); 5];
    assert_eq!(refused(&gzip(&tar(&many))), Refused::TooMuch(256 << 20));
}

#[test]
fn of_too_many_files_none_is_read() {
    let names: Vec<String> = (0..=MOST_MEMBERS).map(|n| format!("{n}")).collect();
    let files: Vec<(&str, &[u8])> = names.iter().map(|name| (name.as_str(), &b""[..])).collect();
    assert_eq!(refused(&gzip(&tar(&files))), Refused::TooMany);
    assert_eq!(refused(&zip(&files)), Refused::TooMany);
}

#[test]
fn a_password_is_asked_for_by_name() {
    // The bit that says so, in both headers of the only member.
    let mut bytes = zip(&[("bvh.rs", b"tree")]);
    let directory = bytes
        .windows(4)
        .position(|four| four == b"PK\x01\x02")
        .unwrap();
    bytes[6] |= 1;
    bytes[directory + 8] |= 1;
    assert_eq!(refused(&bytes), Refused::Encrypted("bvh.rs".to_owned()));
}
