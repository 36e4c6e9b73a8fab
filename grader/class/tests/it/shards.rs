//! Classes that are graded in shards.

use std::path::Path;
use std::process::Output;

use crate::harness::{
    TestClass, class_command, comparable_files, exit_code_and_stderr, successful_stdout,
};

const ITEMS: [&str; 1] = ["camera.offset"];

fn grade_shard(class: &TestClass, exam: &str, which: &str, more: &[&str]) -> String {
    let out = class.path_beside(&format!("shard-{}", which.replace('/', "-")));
    let output = class_command()
        .arg(class.input())
        .args(["--exam", exam, "--no-reference", "--isolation", "none"])
        .args(["--shard", which])
        .args(more)
        .arg("--out")
        .arg(&out)
        .output()
        .unwrap();
    successful_stdout(&output);
    out.to_str().unwrap().to_owned()
}

fn merge(shards: &[&str], out: &Path) -> Output {
    let mut merge = class_command();
    merge.arg("merge").args(shards).arg("--out").arg(out);
    merge.output().unwrap()
}

#[test]
fn merged_shards_equal_an_unsharded_run() {
    let class = TestClass::of_three();
    let exam = class.small_exam(&ITEMS);
    let policy = class.write_beside("policy.toml", "[points]\nout_of = 7\n");
    let more = ["--policy", policy.as_str()];
    successful_stdout(&class.grade(&exam, &more));
    let shards = ["1/2", "2/2"].map(|which| grade_shard(&class, &exam, which, &more));
    let [one, two] = shards.each_ref().map(String::as_str);
    let out = class.path_beside("merged");
    successful_stdout(&merge(&[one, two], &out));
    // The merge takes the policy from the shards, and remembers that.
    let files = |folder: &Path| {
        let mut files = comparable_files(folder);
        let run = files.remove(Path::new("run.json")).unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        let here = folder.canonicalize().unwrap().display().to_string();
        let files = files.into_iter().map(|(path, bytes)| {
            let name = path.to_string_lossy().into_owned();
            let bytes = if name.ends_with("report.html") {
                text(bytes).replace(&here, "OUT").into_bytes()
            } else {
                bytes
            };
            (name, bytes)
        });
        let run = text(run).replace(",\n      \"is_of_parts\": true", "");
        (run, files.collect::<Vec<_>>())
    };
    assert_eq!(files(&out), files(&class.out()));
    assert!(class.read("grades.csv").contains("graded,7,"));

    let refused = |shards: &[&str], why: &str| {
        let (code, error) = exit_code_and_stderr(&merge(shards, &out));
        assert_eq!(code, 2);
        assert!(error.contains(why), "{error}");
    };
    refused(&[one, two, one], "were both given the same --shard?");
    refused(&[one], "results are missing for 2/2");
    for out in [one.to_owned(), format!("{two}/merged")] {
        let before = comparable_files(Path::new(one));
        let merged = merge(&[one, two], Path::new(&out));
        let (code, error) = exit_code_and_stderr(&merged);
        assert_eq!(code, 2);
        assert!(error.contains("choose another folder for --out"), "{error}");
        assert_eq!(comparable_files(Path::new(one)), before);
    }
    let other = class.write_beside("other.toml", "[points]\nout_of = 8\n");
    grade_shard(&class, &exam, "2/2", &["--policy", &other]);
    refused(&[one, two], "the policy differs");
}

/// Every second submission of one list and of a longer one could leave somebody out.
#[test]
fn parts_of_different_lists_of_submissions_are_refused() {
    let class = TestClass::of_three();
    let exam = class.small_exam(&ITEMS);
    let one = grade_shard(&class, &exam, "1/2", &[]);
    let class = class.with_folder("dora").with_folder("eve");
    let two = grade_shard(&class, &exam, "2/2", &[]);
    let out = class.path_beside("merged");
    let (code, error) = exit_code_and_stderr(&merge(&[&one, &two], &out));
    assert_eq!(code, 2);
    let why = "submissions were added or removed between them";
    assert!(error.contains(why), "{error}");
    assert!(!out.exists());
    grade_shard(&class, &exam, "1/2", &[]);
    successful_stdout(&merge(&[&one, &two], &out));
    let grades = std::fs::read_to_string(out.join("grades.csv")).unwrap();
    assert_eq!(grades.lines().count(), 6, "{grades}");
}

#[test]
fn results_of_another_part_or_among_the_submissions_are_refused() {
    let class = TestClass::of_three();
    let exam = class.small_exam(&ITEMS);
    grade_shard(&class, &exam, "1/2", &[]);
    let grade = |out: &Path, more: &[&str]| {
        let mut command = class_command();
        command
            .arg(class.input())
            .args(["--exam", &exam, "--isolation", "none"]);
        command
            .arg("--no-reference")
            .args(more)
            .arg("--out")
            .arg(out);
        exit_code_and_stderr(&command.output().unwrap())
    };
    let shard = class.path_beside("shard-1-2");
    for more in [&["--shard", "1/3"][..], &[]] {
        let (code, error) = grade(&shard, more);
        assert_eq!(code, 2);
        assert!(
            error.contains("has the results of part 1/2, and not of"),
            "{error}"
        );
    }
    let (code, error) = grade(&class.input().join("graded"), &[]);
    assert_eq!(code, 2);
    assert!(error.contains("would be taken for submissions"), "{error}");
    assert!(!class.input().join("graded").exists());
}

#[test]
fn an_estimate_grades_a_few_submissions_and_keeps_their_results() {
    let class = TestClass::of_three()
        .with_reference("dora")
        .with_reference("eve");
    let exam = class.small_exam(&ITEMS);
    let estimate = || successful_stdout(&class.grade(&exam, &["--estimate", "--jobs", "1"]));
    let text = estimate();
    assert!(text.contains("estimate from 2 submissions"), "{text}");
    assert!(text.contains("2 more submissions, 1 at a time"), "{text}");
    assert!(
        text.contains("64 machines like this") && text.contains("core-hours"),
        "{text}"
    );
    assert!(!class.out().join("grades.csv").exists());
    let text = estimate();
    assert!(text.contains("0 more submissions"), "{text}");
    let text = estimate();
    assert!(text.contains("nothing to estimate"), "{text}");
    let graded = class.grade(&exam, &[]);
    let lines = String::from_utf8_lossy(&graded.stderr);
    assert!(!lines.contains(" of "), "all results were kept: {lines}");
    assert!(successful_stdout(&graded).contains("4 graded"));
}
