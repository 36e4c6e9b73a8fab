//! The package check finds the problems with a package before it is tried or uploaded.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use grader::doctor::package::problems;
use grader::handed_out::RAYS;
use tempfile::TempDir;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use crate::formats::small_exam;

const SETUP: (&str, &str) = ("setup.sh", "#!/bin/sh\n");
const RUN: (&str, &str) = ("run_autograder", "#!/bin/sh\n");
const POLICY: (&str, &str) = ("pathtracing/policy.toml", "");
const GRADE: (&str, &str) = ("pathtracing/grade", "#!/bin/sh\n");
/// The other files of a package, which only need to exist.
const OTHER_FILES: [(&str, &str); 6] = [
    ("pathtracing/grader/src/main.rs", ""),
    ("pathtracing/student/framework/src/lib.rs", ""),
    ("pathtracing/reference/src/bvh.rs", ""),
    ("pathtracing/reference/substitution/lib.rs", ""),
    (
        "pathtracing/crates/registry/cache/x/landlock-0.4.7.crate",
        "",
    ),
    (
        "pathtracing/crates/registry/index/x/.cache/la/nd/landlock",
        "",
    ),
];

/// Returns a zip of these files, each with this mode.
fn make_zip(files: &[(&str, &str)], mode: u32) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in files {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .unix_permissions(mode);
        archive.start_file(*name, options).unwrap();
        archive.write_all(text.as_bytes()).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// Checks a package that consists of these bytes.
fn check_bytes(bytes: &[u8]) -> String {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("package.zip");
    fs::write(&path, bytes).unwrap();
    check_path(&path)
}

/// Checks the package at this path. Returns its problems, one per line, without the path of the
/// package's folder.
fn check_path(path: &Path) -> String {
    let found = match problems(path, &RAYS) {
        Ok(problems) => problems,
        Err(error) => vec![error.to_string()],
    };
    let folder = format!("{}/", path.parent().unwrap().display());
    let lines = found.iter().map(|problem| format!("{problem}\n"));
    lines.collect::<String>().replace(&folder, "")
}

/// Returns the files of a complete package without the file `name`, or with `file` in its place.
fn package_except<'a>(
    exam: &'a str,
    name: &str,
    file: Option<(&'a str, &'a str)>,
) -> Vec<(&'a str, &'a str)> {
    let files = [SETUP, RUN, GRADE, ("pathtracing/exam.json", exam), POLICY];
    let files = files.into_iter().chain(OTHER_FILES);
    files
        .filter(|(other, _)| *other != name)
        .chain(file)
        .collect()
}

#[test]
fn a_complete_package_has_no_problems() {
    let exam = small_exam("final");
    let complete = make_zip(&package_except(&exam, "", None), 0o755);
    assert_eq!(check_bytes(&complete), "");
}

#[test]
fn reports_each_problem_with_a_remedy() {
    let (good, practice) = (small_exam("final"), small_exam("practice"));
    let exam = "pathtracing/exam.json";
    let zip = |files: &[(&str, &str)]| make_zip(files, 0o755);
    let without = |name| zip(&package_except(&good, name, None));
    let with = |name, text| zip(&package_except(&good, name, Some((name, text))));
    let windows = "#!/bin/sh\r\n";
    let newest = "#!/bin/sh\nrustup-init -y --default-toolchain stable\n";
    // The package contains a crate, but none of the crates that only Linux needs.
    let other_crate = ("pathtracing/crates/registry/cache/x/glam-0.34.crate", "");
    let not_of_linux = package_except(&good, OTHER_FILES[4].0, Some(other_crate));
    let folder = [("mine/setup.sh", ""), ("mine/run_autograder", "")];
    let mut damaged = with(OTHER_FILES[0].0, "fn main() { todo!() }");
    let offset = damaged.windows(4).position(|bytes| bytes == b"todo");
    damaged[offset.unwrap()] = b'T';
    let wrong_policy = "[visibility.items]\ncamra = 'all'";
    let cases = [
        ("the folder was zipped", zip(&folder)),
        ("empty", zip(&[])),
        ("Windows line endings", with(SETUP.0, windows)),
        (
            "Windows line endings in a subfolder",
            with(GRADE.0, windows),
        ),
        ("newest Rust", with(SETUP.0, newest)),
        ("no shebang line", with(RUN.0, "echo")),
        (
            "not executable",
            make_zip(&package_except(&good, "", None), 0o644),
        ),
        ("practice exam", with(exam, &practice)),
        // Truncate the exam before any answer, so that the error position doesn't depend on its
        // contents.
        ("truncated exam", with(exam, &good[..100])),
        ("no exam, no crates", zip(&[SETUP, RUN, POLICY])),
        ("no grading script", without(GRADE.0)),
        ("no solution", without(OTHER_FILES[2].0)),
        ("not written on Linux", zip(&not_of_linux)),
        ("invalid policy", with(POLICY.0, wrong_policy)),
        ("not a zip", b"not a zip".to_vec()),
        ("damaged", damaged),
    ];
    let mut all = String::new();
    for (what, bytes) in &cases {
        let text = check_bytes(bytes);
        assert!(!text.is_empty(), "{what}");
        all.push_str(&format!("-- {what}\n{text}\n"));
    }
    insta::assert_snapshot!(all);
}

/// Writes files below a folder.
fn write_files(folder: &Path, files: &[(&str, &[u8])]) {
    for (name, bytes) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
}

#[test]
fn recognises_package_folders_and_lists_missing_files() {
    let folder = TempDir::new().unwrap();
    let package = folder.path().join("package");
    fs::create_dir(&package).unwrap();
    let nothing = check_path(&package);
    assert!(nothing.contains("it is not a package"), "{nothing}");

    let policy = ("pathtracing/policy.toml", "");
    let zip = make_zip(&[OTHER_FILES[0], OTHER_FILES[1], policy], 0o644);
    let entry = ("autograder.py", b"".as_slice());
    write_files(&package, &[entry, ("pathtracing.zip", &zip)]);
    assert_eq!(check_path(&package), "");
    for broken in [b"not a zip".as_slice(), &make_zip(&OTHER_FILES, 0o644)] {
        write_files(&package, &[("pathtracing.zip", broken)]);
        let text = check_path(&package);
        assert!(text.contains("package classroom50`"), "{text}");
    }

    let template = folder.path().join("template");
    let workflow = (".github/workflows/grade.yml", b"".as_slice());
    write_files(&template, &[workflow, ("reference/src/bvh.rs", b"")]);
    let text = check_path(&template);
    for problem in ["student/src/bvh.rs is missing", "it contains reference"] {
        assert!(text.contains(problem), "{text}");
    }
}
