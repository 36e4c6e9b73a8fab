//! Tests for collecting a submission.

use std::fs;
use std::io::{Cursor, Write};

use tempfile::TempDir;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::*;
use crate::handed_out::RAYS;

/// Files, each with its path and its contents.
pub(super) type Files<'a> = &'a [(&'a str, &'a [u8])];

/// Returns a folder with these files.
pub(super) fn folder(files: Files) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (path, bytes) in files {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
    folder
}

/// Returns a tar with these files.
pub(super) fn tar(files: Files) -> Vec<u8> {
    let mut builder = tar::Builder::new(Vec::new());
    for (path, bytes) in files {
        let mut header = tar::Header::new_gnu();
        header.set_size(bytes.len() as u64);
        header.set_mode(0o644);
        builder.append_data(&mut header, path, *bytes).unwrap();
    }
    builder.into_inner().unwrap()
}

/// Returns a zip with these files.
pub(super) fn zip(files: Files, method: CompressionMethod) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(method);
    for (path, bytes) in files {
        writer.start_file(*path, options).unwrap();
        writer.write_all(bytes).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// Collects the submission from a folder with these files.
pub(super) fn collected(files: Files) -> Result<Submission, SubmissionError> {
    Submission::collect(folder(files).path(), &RAYS)
}

/// Returns the limit that a submission exceeds, if any.
pub(super) fn exceeded<T>(collected: Result<T, SubmissionError>) -> Option<Limit> {
    match collected {
        Ok(_) => None,
        Err(SubmissionError::TooMany(_, limit)) => Some(limit),
        Err(other) => panic!("{other}"),
    }
}

/// Returns the result of reading a task file.
pub(super) fn text<'a>(
    submission: &'a Submission,
    name: &str,
) -> &'a Result<String, TaskFileError> {
    let mut files = submission.files.iter();
    let (_, text) = files.find(|(file, _)| file.name == name).unwrap();
    text
}

fn write_files(folder: &Path, text: &str) {
    fs::create_dir_all(folder).unwrap();
    for file in RAYS.file_names() {
        fs::write(folder.join(file), text).unwrap();
    }
}

#[test]
fn copies_in_other_folders_do_not_stop_students_at_their_own_work() {
    let package = tempfile::tempdir().unwrap();
    write_files(&package.path().join("src"), "new");
    write_files(&package.path().join("src/yesterday"), "old");
    let own = Submission::collect_package(package.path(), &RAYS).unwrap();
    let mut own = own.files.iter();
    assert!(own.all(|(_, text)| text.as_deref() == Ok("new")));
    fs::remove_file(package.path().join("src/camera.rs")).unwrap();
    let own = Submission::collect_package(package.path(), &RAYS).unwrap();
    assert_eq!(texts(&own).len(), RAYS.files.len() - 1, "one is missing");
    write_files(&package.path().join("src"), "new");
    // If this is handed in, it is unclear which copy is meant.
    let handed_in = Submission::collect(package.path(), &RAYS);
    assert!(matches!(
        handed_in,
        Err(SubmissionError::Ambiguous { copies, .. }) if copies == ["src", "src/yesterday"]
    ));
    // The files are also found without a package.
    let folder = tempfile::tempdir().unwrap();
    write_files(&folder.path().join("my/work"), "new");
    let found = Submission::collect_package(folder.path(), &RAYS).unwrap();
    assert!(found.files.iter().all(|(_, text)| text.is_ok()));
}

/// Returns the files that could be read from a submission.
pub(super) fn texts(submission: &Submission) -> Vec<(&str, &str)> {
    let files = submission.files.iter();
    let texts = files.filter_map(|(file, text)| Some((file.name, text.as_deref().ok()?)));
    texts.collect()
}

#[test]
fn only_the_starters_files_are_as_handed_out() {
    let folder = tempfile::tempdir().unwrap();
    for file in RAYS.files {
        fs::write(folder.path().join(file.name), file.starter).unwrap();
    }
    let collect = || Submission::collect(folder.path(), &RAYS).unwrap();
    let is_as_handed_out = || collect().is_as_handed_out();
    assert!(is_as_handed_out());
    fs::write(folder.path().join("bvh.rs"), "new").unwrap();
    assert!(!is_as_handed_out());
    fs::remove_file(folder.path().join("bvh.rs")).unwrap();
    assert!(!is_as_handed_out(), "a file is missing");
}

#[cfg(unix)]
#[test]
fn a_link_matters_only_if_files_are_missing_that_it_may_lead_to() {
    let folder = tempfile::tempdir().unwrap();
    let link = |name: &str| {
        crate::machine::system::symlink("elsewhere".as_ref(), &folder.path().join(name)).unwrap();
    };
    let collect = || Submission::collect(folder.path(), &RAYS);
    let refused = || match collect() {
        Err(SubmissionError::Link { link, .. }) => link,
        other => panic!("{other:?}"),
    };
    link("notes");
    assert_eq!(refused(), "notes", "there is nothing else");
    let source = folder.path().join("work");
    fs::create_dir(&source).unwrap();
    fs::write(source.join("bvh.rs"), "new").unwrap();
    assert_eq!(texts(&collect().unwrap()), [("bvh.rs", "new")]);
    link("src");
    assert_eq!(refused(), "src");
    write_files(&source, "new");
    assert!(collect().is_ok());
    // However, a graded file must not be replaced by a link.
    fs::remove_file(source.join("bvh.rs")).unwrap();
    link("work/bvh.rs");
    assert_eq!(refused(), "work/bvh.rs");
}

#[test]
fn names_of_task_files_and_of_their_folders_may_lead_to_files() {
    for link in ["bvh.rs", "a/Bvh.rs", "src", "a/student"] {
        assert!(may_lead_to_files(link, &RAYS), "{link}");
    }
    for link in ["notes", "src/notes", "tree", "lib.rs"] {
        assert!(!may_lead_to_files(link, &RAYS), "{link}");
    }
}

#[test]
fn a_file_may_be_as_long_as_the_limit() {
    assert!(decode(vec![b'/'; 1 << 20]).is_ok());
    assert_eq!(
        decode(vec![b' '; (1 << 20) + 1]),
        Err(TaskFileError::TooLong)
    );
}

#[test]
fn the_line_of_a_byte_that_is_not_text_is_named() {
    for (bytes, line) in [(&b"ab\xffc\n"[..], 1), (b"a\nb\n\xff\n", 3)] {
        let error = decode(bytes.to_vec()).unwrap_err();
        let expected = format!(
            "bvh.rs is not UTF-8 text: line {line} has an invalid byte. Save the file as UTF-8"
        );
        assert_eq!(error.message("bvh.rs"), expected);
    }
}

#[test]
fn only_given_files_that_were_changed_are_noted() {
    // Git may have changed the line endings.
    let library = RAYS.given_file("lib.rs").unwrap();
    let library = library.text.replace('\n', "\r\n");
    let submission = collected(&[
        ("bvh (1).rs", b"new"),
        ("README.md", b"read me"),
        ("helper.rs", b""),
        ("main.rs", b"fn main() {}"),
        ("world.rs", b"mine"),
        ("lib.rs", library.as_bytes()),
    ])
    .unwrap();
    assert_eq!(texts(&submission), [("bvh.rs", "new")]);
    let notes = [
        "helper.rs is not one of the task files and is ignored",
        "world.rs differs from the given file, which is used instead of yours",
    ];
    assert_eq!(submission.notes, notes);
}

#[test]
fn the_number_of_notes_is_limited() {
    let other = |n: u32| (format!("{n}.rs"), Vec::new());
    assert_eq!(notes(&(0..30).map(other).collect(), &RAYS).len(), MAX_NOTES);
}

#[test]
fn names_are_printed_shortened_and_without_control_characters() {
    assert_eq!(display_name("a\u{7}\n.rs"), "a\\u{7}\\n.rs");
    let long = "é".repeat(MAX_NAME_CHARS);
    assert_eq!(display_name(&long), long);
    assert_eq!(display_name(&format!("{long}é")), format!("{long}…"));
}

#[test]
fn a_submission_is_named_after_the_folder_that_the_path_leads_to() {
    let folder = tempfile::tempdir().unwrap();
    write_files(&folder.path().join("ann"), "new");
    for path in ["ann", "ann/."] {
        let found = Submission::collect(&folder.path().join(path), &RAYS);
        assert_eq!(found.unwrap().name, "ann");
    }
}

#[test]
fn of_uploads_with_the_same_name_the_last_one_counts() {
    let folder = tempfile::tempdir().unwrap();
    let upload = |name: &str, file: &str, text: &str| {
        let path = folder.path().join(file);
        fs::write(&path, text).unwrap();
        (name.to_owned(), path)
    };
    let files = [
        upload("bvh.rs", "1", "old"),
        upload("bvh.rs", "2", "new"),
        upload("notes.txt", "3", "not code"),
    ];
    let found = Submission::from_files("ann", &files, &RAYS).unwrap();
    assert_eq!(
        (&*found.name, &*texts(&found)),
        ("ann", &[("bvh.rs", "new")][..])
    );
    let note = "bvh.rs was handed in more than once: the last version is graded, and an earlier, \
                different one is ignored";
    assert_eq!(found.ignored_copies, [note]);
    // The starter's text doesn't count as a version.
    let starter = upload("bvh.rs", "4", RAYS.task_file("bvh.rs").unwrap().starter);
    let with_starter = [files[1].clone(), starter];
    let found = Submission::from_files("ann", &with_starter, &RAYS).unwrap();
    assert_eq!(texts(&found), [("bvh.rs", "new")]);
    assert_eq!(found.ignored_copies, [""; 0]);
    let error = Submission::from_files("ann", &files[2..], &RAYS).unwrap_err();
    assert!(
        error.to_string().ends_with("it contains notes.txt"),
        "{error}"
    );
}

/// Returns the message about a submission that isn't graded, with its path replaced by `it`.
fn refusal(files: Files) -> String {
    let folder = folder(files);
    let error = Submission::collect(folder.path(), &RAYS).unwrap_err();
    error
        .to_string()
        .replace(&folder.path().display().to_string(), "it")
}

#[test]
fn files_in_several_places_are_graded_together() {
    let parts: Files = &[
        ("task1/camera.rs", b"a"),
        ("task2/triangle.rs", b"b"),
        ("task2/sphere.rs", b"c"),
        ("task3/bbox.rs", b"d"),
        ("task3/bvh.rs", b"e"),
        ("task3/helper.rs", b""),
    ];
    let in_zip = |files: Files| zip(files, CompressionMethod::Deflated);
    let (one, two, all) = (in_zip(&parts[..3]), in_zip(&parts[3..]), in_zip(parts));
    let each: Vec<_> = parts.iter().map(|file| in_zip(&[*file])).collect();
    let names: Vec<String> = (0..each.len())
        .map(|index| format!("{index}.zip"))
        .collect();
    let each = names.iter().zip(&each);
    let each: Vec<_> = each
        .map(|(name, zip)| (name.as_str(), zip.as_slice()))
        .collect();
    let beside = parts
        .iter()
        .map(|(path, text)| match path.rsplit_once('/') {
            Some((_, name)) if name != "bvh.rs" => (format!("src/{name}"), *text),
            _ => ("bvh.rs".to_owned(), *text),
        });
    let beside: Vec<_> = beside.collect();
    let beside: Vec<_> = beside
        .iter()
        .map(|(path, text)| (path.as_str(), *text))
        .collect();
    let with_zip = [&parts[..3], &[("rest.zip", &two)]].concat();
    let submissions: [Files; 6] = [
        parts,
        &[("all.zip", &all)],
        &[("1.zip", &one), ("2.zip", &two)],
        &each,
        &beside,
        &with_zip,
    ];
    for files in submissions {
        let found = collected(files).unwrap();
        let texts = texts(&found);
        let texts: String = texts.into_iter().map(|(_, text)| text).collect();
        assert_eq!((texts.len(), &*texts), (5, "abcde"), "{files:?}");
        assert_eq!(found.ignored_copies, [""; 0]);
    }
    let notes = collected(parts).unwrap().notes;
    assert_eq!(
        notes,
        ["helper.rs is not one of the task files and is ignored"]
    );
    let older = [parts, &[("old/bvh.rs", b"older"), ("old/sphere.rs", b"c")]].concat();
    let expected = "it contains different copies of bvh.rs, in old and task3: keep only the one \
                    that should be graded";
    assert_eq!(refusal(&older), expected);
}

#[test]
fn a_copy_next_to_a_file_is_never_chosen_silently() {
    let starter = RAYS.task_file("bvh.rs").unwrap().starter.as_bytes();
    for copy in ["bvh-1.rs", "bvh (1).rs", "bvh_1.rs"] {
        let expected = format!(
            "it contains different copies of bvh.rs, in bvh.rs and {copy}: keep only the one that \
             should be graded"
        );
        assert_eq!(refusal(&[("bvh.rs", b"new"), (copy, b"newer")]), expected);
        for same in [&b"new"[..], starter] {
            let found = collected(&[("bvh.rs", b"new"), (copy, same)]).unwrap();
            assert_eq!(texts(&found), [("bvh.rs", "new")]);
            assert_eq!(found.ignored_copies, [""; 0]);
        }
        let found = collected(&[(copy, b"new")]).unwrap();
        assert_eq!(texts(&found), [("bvh.rs", "new")]);
        assert_eq!(
            found.ignored_copies,
            [format!("{copy} is graded as bvh.rs")]
        );
        let found = collected(&[("old/bvh.rs", b"old"), (&format!("new/{copy}"), b"new")]);
        let Err(SubmissionError::Ambiguous { files, copies, .. }) = found else {
            panic!("{found:?}");
        };
        assert_eq!(
            (&*files[0], copies),
            ("bvh.rs", vec![format!("new/{copy}"), "old".to_owned()])
        );
    }
}

#[test]
fn files_with_other_names_are_named_once_with_advice() {
    let expected = format!(
        "it contains none of {} in any of its folders; it contains camera.rs.txt, bvh.rs.txt: name \
         each file exactly like its task file, such as camera.rs; names must end in .rs",
        RAYS.file_list()
    );
    let files: Files = &[
        ("bvh.rs.txt", b"new"),
        ("camera.rs.txt", b"new"),
        (".git/HEAD", b""),
    ];
    assert_eq!(refusal(files), expected);
    let nothing = refusal(&[(".git/HEAD", b"")]);
    assert!(nothing.ends_with("; it contains no files"), "{nothing}");
}

#[test]
fn a_path_without_a_submission_is_explained() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("b.txt"), "").unwrap();
    fs::create_dir(folder.path().join("a")).unwrap();
    let error = |path: &Path| Submission::collect(path, &RAYS).unwrap_err().to_string();
    let none = error(folder.path());
    assert!(
        none.ends_with("in any of its folders; it contains a, b.txt"),
        "{none}"
    );
    let archive = folder.path().join("a.tar");
    fs::write(
        &archive,
        tar(&[("b/c.rs", b""), ("b/d", b""), ("a.txt", b"")]),
    )
    .unwrap();
    let none = error(&archive);
    assert!(none.ends_with("it contains a.txt, b"), "{none}");
    let absent = error(&folder.path().join("absent"));
    assert!(
        absent.ends_with(
            "does not exist: pass the folder that contains the task files, such as `student`"
        ),
        "{absent}"
    );
    let text = error(&folder.path().join("b.txt"));
    assert!(text.contains("it is empty"), "{text}");
}
