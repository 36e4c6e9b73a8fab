//! Tests for the output formats: each output must match the documentation of its platform and its
//! snapshot.

mod channels;
mod characters;
mod golden;
mod leaks;
pub mod models;
mod numbers;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::sync::LazyLock;

use crate::harness::{Submission, workspace};
use grader::format::{FORMATS, FormatContext, FormatSpec, StudentView};
use serde_json::Value;

/// Returns all formats that students can read, i.e. all except the score file.
pub fn student_formats() -> impl Iterator<Item = &'static FormatSpec> {
    let formats = FORMATS.into_iter();
    formats.filter(|format| format.render.is_some())
}

/// Returns everything that students can read in the formats, keyed by the name of the output. The
/// formats come from the table of all formats, so that new formats are tested too.
pub fn rendered(view: &StudentView, context: &FormatContext) -> FormatTexts {
    let files = student_formats().filter_map(|format| Some((format.id, format.render?)));
    let logs = FORMATS.into_iter();
    let logs = logs.filter_map(|format| Some(("log", format.runner_commands?)));
    let outputs = files.chain(logs);
    outputs
        .map(|(output, render)| (output, render(view, context)))
        .collect()
}

/// The environment variables of classroom50's runner.
const RUNNER_VARIABLES: [(&str, &str); 9] = [
    ("CLASSROOM", "gfx-f26"),
    ("ASSIGNMENT", "pathtracer"),
    ("ASSIGNMENT_TYPE", "individual"),
    ("OWNER", "alice"),
    ("SUBMISSION_TAG", "submit/2026-11-20T21-10-05Z-a1b2c3d"),
    ("COMMIT_URL", "https://example.org/commit/a1b2c3d"),
    ("RELEASE_URL", "https://example.org/releases/1"),
    ("REVIEW_URL", "https://example.org/compare/1"),
    ("SUBMITTED_AT", "2026-11-20T21:09:58Z"),
];

/// Items that the shortened exam contains beside the first item of each task. A few items are
/// enough, because the formats treat all items alike.
const MORE_ITEMS: [&str; 2] = ["camera.unit_length", "sphere.far_root"];

/// The outputs of one run, keyed by format. The keys `log` and `errors` stand for standard output
/// and standard error, and `json` stands for the score file.
pub type FormatTexts = BTreeMap<&'static str, String>;

/// Returns a shortened practice exam with this id.
pub fn small_exam(id: &str) -> String {
    let text = fs::read_to_string(workspace().join("grader/exams/practice.json")).unwrap();
    let mut exam: Value = serde_json::from_str(&text).unwrap();
    exam["id"] = id.into();
    let items = exam["items"].as_array_mut().unwrap();
    let mut tasks = BTreeSet::new();
    let mut kept = BTreeSet::new();
    items.retain(|item| {
        let id = item["id"].as_str().unwrap();
        let is_first = tasks.insert(id.split('.').next().unwrap().to_owned());
        let is_kept = is_first || MORE_ITEMS.contains(&id);
        is_kept && kept.insert(id.to_owned())
    });
    for item in items {
        if let Some(needs) = item.get_mut("needs").and_then(Value::as_array_mut) {
            needs.retain(|id| kept.contains(id.as_str().unwrap()));
        }
    }
    exam.to_string()
}

/// The outputs for a submission that contains a known mistake and is in a folder called `partial`.
/// It is graded with the shortened practice exam.
pub static KNOWN_MISTAKE: LazyLock<FormatTexts> = LazyLock::new(|| {
    let submission = Submission::far_first("partial");
    grade_in_all_formats(&submission, &small_exam("practice"), &[])
});

/// Grades a submission once. Returns the output in all formats.
pub fn grade_in_all_formats(
    submission: &Submission,
    exam: &str,
    arguments: &[String],
) -> FormatTexts {
    let mut command = submission.command();
    command
        .current_dir(submission.path().parent().unwrap())
        .args(submission.file_option("--exam", "exam.json", exam))
        .arg("--format")
        .args(student_formats().map(|format| format.id))
        .args(arguments)
        .envs(RUNNER_VARIABLES)
        .env_remove("GITHUB_STEP_SUMMARY")
        .env_remove("GITHUB_WORKSPACE")
        .env("GITHUB_ACTIONS", "true");
    let graded = submission.run(&mut command);
    assert_eq!(graded.exit_code(), 0, "{}", graded.error());
    let (out, output) = (submission.out(), graded.output);
    let text = |format: &FormatSpec| fs::read_to_string(out.join(format.file)).unwrap();
    let mut written: FormatTexts = FORMATS
        .into_iter()
        .map(|format| (format.id, text(format)))
        .collect();
    written.insert("log", String::from_utf8(output.stdout).unwrap());
    written.insert("errors", String::from_utf8(output.stderr).unwrap());
    written
}

/// Returns a submission whose panic messages and output attack the programs that display them.
pub fn hostile_submission() -> Submission {
    let head = "pub fn hit(&self, ray: &Ray) -> Option<Trace> {";
    let attack = r#"{head}
        println!("::error::full marks\n##[error]all of them\n</system-out></testsuite>");
        if ray.dir.is_normalized() {
            panic!("\n::set-output name=x::y\n##[warning]z\n]]></failure>\u{1b}[2J```\n</details><script>alert(1)</script>|{ray:?}");
        }"#;
    Submission::reference("forging").with_replaced(
        "sphere.rs",
        head,
        &attack.replace("{head}", head),
    )
}
