//! Archives that are rejected because they are damaged, malicious or too large.

use super::*;

#[test]
fn rejects_two_spellings_of_one_path() {
    let spellings = "src/bvh.rs|./src/bvh.rs|src//bvh.rs|src\\bvh.rs|src/BVH.rs|Src/bvh.rs|\
                     src./bvh.rs|src/bvh.rs |src/bvh.rs..";
    for spelling in spellings.split('|') {
        // The crate that writes zip files refuses to write the same path twice.
        let bytes = match spelling {
            "src/bvh.rs" => tar(&[("src/bvh.rs", b"1"), (spelling, b"2")]),
            _ => zip(&[("src/bvh.rs", b"1"), (spelling, b"2")]),
        };
        let why = collect_error(&bytes);
        let is_duplicate = matches!(why, ArchiveError::DuplicatePath(..));
        assert!(is_duplicate, "{spelling}: {why}");
    }
    let (composed, decomposed) = ("Zo\u{e9}/bvh.rs", "Zoe\u{301}/bvh.rs");
    let why = collect_error(&zip(&[(composed, b"1"), (decomposed, b"2")]));
    assert!(matches!(why, ArchiveError::DuplicatePath(..)), "{why}");
}

#[test]
fn rejects_paths_outside_the_archive_and_escapes_them() {
    let outside = |path: &str| ArchiveError::PathOutside(path.to_owned());
    for path in [
        "../bvh.rs",
        "/bvh.rs",
        "a/../../bvh.rs",
        r"..\bvh.rs",
        "C:bvh.rs",
    ] {
        let normalized = outside(&path.replace('\\', "/"));
        let tarred = tar_with(path, EntryType::Regular, b"");
        for bytes in [zip(&[(path, b"")]), tarred] {
            assert_eq!(collect_error(&bytes), normalized);
        }
    }
    let odd = collect_error(&zip(&[("../\u{1b}[2J\n\u{202e}x", b"")]));
    assert_eq!(odd, outside(r"../\u{1b}[2J\n\u{202e}x"));
}

#[test]
fn rejects_links_and_devices_except_under_target() {
    use EntryType::{Block, Char, Fifo, Link, Symlink};
    let why = ArchiveError::NotRegular("bvh.rs".to_owned());
    for kind in [Symlink, Link, Char, Block, Fifo] {
        assert_eq!(collect_error(&tar_with("bvh.rs", kind, b"")), why);
    }
    let built = listing(&tar_with("hw/target/debug/hw", EntryType::Link, b""));
    assert!(built.members.is_empty() && built.errors.is_empty());

    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default();
    writer
        .add_symlink("bvh.rs", "/etc/passwd", options)
        .unwrap();
    let zip = writer.finish().unwrap().into_inner();
    assert_eq!(collect_error(&zip), why);
}

#[test]
fn reports_what_is_wrong_with_an_unusable_archive() {
    let all: [&[u8]; 3] = [b"", &zip(&[]), &[0; 1024]];
    for empty in all {
        assert_eq!(collect_error(empty), ArchiveError::Empty);
    }
    let mut with_zeros = [0; 1024];
    with_zeros[0] = b'x';
    let gzipped = gzip(b"pub struct Sphere");
    let others: [&[u8]; 4] = [b"%PDF-1.7", &gzipped, &[b'x'; 1024], &with_zeros];
    for other in others {
        assert_eq!(collect_error(other), ArchiveError::NotAnArchive);
    }
    let other = collect("a.zip", &zip(&[("a/b/c/d.rs", b"")]));
    assert!(matches!(other, Err(SubmissionError::NoTaskFiles { .. })));
    let several = collect("a.zip", &zip(&[("a/bvh.rs", b""), ("b/bvh.rs", b"x")]));
    assert!(matches!(several, Err(SubmissionError::Ambiguous { .. })));
}

#[test]
fn truncated_archives_are_damaged_or_lack_files() {
    for whole in [zip(FILES), tar(FILES), gzip(&tar(FILES))] {
        for length in (0..whole.len()).step_by(37) {
            match collect("a", &whole[..length]) {
                Ok(submission) => assert_eq!(submission.files.len(), RAYS.files.len()),
                Err(SubmissionError::Archive { .. } | SubmissionError::NoTaskFiles { .. }) => {}
                Err(other) => panic!("{length}: {other}"),
            }
        }
    }
    let half = collect_error(&zip(FILES)[..200]);
    assert!(matches!(half, ArchiveError::Damaged(_)));
}

#[test]
fn limits_how_much_an_archive_bomb_inflates() {
    let zeros = vec![0; 8 << 20];
    let files: Files = &[("bvh.rs", &zeros), ("sphere.rs", b"fine")];
    for bomb in [zip(files), gzip(&tar(files))] {
        let submission = collect("bomb", &bomb).unwrap();
        assert_eq!(*text(&submission, "bvh.rs"), Err(TaskFileError::TooLong));
        assert_eq!(*text(&submission, "sphere.rs"), Ok("fine".to_owned()));
    }
    // Members of a tar are inflated even if they aren't requested. A gzip file may consist of
    // several streams, so this repeats one compressed member, leaving out the end of the tar.
    let header = 512;
    let part = gzip(&tar(&[("film.mp4", &zeros)])[..header + zeros.len()]);
    let too_large = ArchiveError::TooLarge(256 << 20);
    assert_eq!(collect_error(&part.repeat(32)), too_large);
    let fine = [part.repeat(31), gzip(&tar(&files[1..]))].concat();
    assert!(text(&collect("film", &fine).unwrap(), "sphere.rs").is_ok());
}

#[test]
fn rejects_archives_with_too_many_files() {
    const MOST: usize = 50_000;
    let packs: [fn(Files) -> Vec<u8>; 2] = [zip, |files| gzip(&tar(files))];
    for pack in packs {
        let bytes = packed(pack, (0..=MOST).map(|n| n.to_string()), b"");
        assert_eq!(collect_error(&bytes), ArchiveError::TooManyFiles(MOST));
    }
}

#[test]
fn reports_the_name_of_an_encrypted_file() {
    // Set the encryption bit in both headers of the only member.
    let mut bytes = zip(&[("bvh.rs", b"tree")]);
    let mut fours = bytes.windows(4);
    let directory = fours.position(|four| four == b"PK\x01\x02").unwrap();
    bytes[6] |= 1;
    bytes[directory + 8] |= 1;
    let encrypted = ArchiveError::Encrypted("bvh.rs".to_owned());
    assert_eq!(collect_error(&bytes), encrypted);
}

#[test]
fn names_the_kind_of_each_archive_that_it_does_not_read() {
    let kinds: [(&[u8], &str); 5] = [
        (b"Rar!\x1a\x07", ".rar"),
        (b"7z\xbc\xaf\x27\x1c", ".7z"),
        (b"\xfd7zXZ\0", ".xz"),
        (b"BZh91AY", ".bz2"),
        (b"\x28\xb5\x2f\xfd", ".zst"),
    ];
    for (head, kind) in kinds {
        assert_eq!(collect_error(head), ArchiveError::UnsupportedKind(kind));
    }
}
