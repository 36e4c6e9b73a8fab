//! A package that would not grade is told before it is uploaded.

use std::io::{Cursor, Write};

use tempfile::TempDir;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use crate::formats::exam;
use crate::harness::grader;

const SETUP: (&str, &str) = ("setup.sh", "#!/bin/sh\n");
const RUN: (&str, &str) = ("run_autograder", "#!/bin/sh\n");
const POLICY: (&str, &str) = ("pathtracing/policy.toml", "");
const CRATE: (&str, &str) = ("pathtracing/crates/registry/cache/x/glam.crate", "");

/// What is wrong, the files that show it, and the mode of all of them.
type Case<'a> = (&'a str, Vec<(&'a str, &'a str)>, u32);

/// What is said of a zip with these files, and the exit code.
fn told(files: &[(&str, &str)], mode: u32) -> (i32, String) {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in files {
        let options = SimpleFileOptions::default().unix_permissions(mode);
        archive.start_file(*name, options).unwrap();
        archive.write_all(text.as_bytes()).unwrap();
    }
    told_of(&archive.finish().unwrap().into_inner())
}

fn told_of(bytes: &[u8]) -> (i32, String) {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("package.zip"), bytes).unwrap();
    let path = folder.path().join("package.zip");
    let output = grader()
        .args(["--doctor", "--package"])
        .arg(&path)
        .output()
        .unwrap();
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8(text).unwrap();
    let text = text.replace(path.to_str().unwrap(), "package.zip");
    (output.status.code().unwrap(), text)
}

#[test]
fn a_whole_one_has_nothing_wrong_with_it() {
    let exam = exam("final");
    let whole = [SETUP, RUN, ("pathtracing/exam.json", &exam), POLICY, CRATE];
    let (code, text) = told(&whole, 0o755);
    assert_eq!(
        (code, text.as_str()),
        (0, "package.zip: nothing is wrong with it\n")
    );
}

#[test]
fn what_is_wrong_is_told_with_what_to_do() {
    let (good, practice) = (exam("final"), exam("practice"));
    let good = ("pathtracing/exam.json", good.as_str());
    let bad: [Case; 8] = [
        (
            "the folder was zipped",
            vec![("mine/setup.sh", ""), ("mine/run_autograder", "")],
            0o755,
        ),
        ("nothing in it", vec![], 0o755),
        (
            "line ends",
            vec![("setup.sh", "#!/bin/sh\r\n"), RUN, good, POLICY, CRATE],
            0o755,
        ),
        (
            "no first line",
            vec![SETUP, ("run_autograder", "echo"), good, POLICY, CRATE],
            0o755,
        ),
        (
            "not executable",
            vec![SETUP, RUN, good, POLICY, CRATE],
            0o644,
        ),
        (
            "practice",
            vec![
                SETUP,
                RUN,
                ("pathtracing/exam.json", &practice),
                POLICY,
                CRATE,
            ],
            0o755,
        ),
        ("no exam, no crates", vec![SETUP, RUN, POLICY], 0o755),
        (
            "policy",
            vec![
                SETUP,
                RUN,
                good,
                (
                    "pathtracing/policy.toml",
                    "[visibility.items]\ncamra = 'all'",
                ),
                CRATE,
            ],
            0o755,
        ),
    ];
    let mut all = String::new();
    for (what, files, mode) in &bad {
        let (code, text) = told(files, *mode);
        assert_eq!(code, 2, "{what}: {text}");
        all.push_str(&format!("-- {what}\n{text}\n"));
    }
    let (code, text) = told_of(b"not a zip");
    assert_eq!(code, 2);
    all.push_str(&format!("-- no zip\n{text}"));
    insta::assert_snapshot!(all);
}
