//! The checks that follow every run. They are the same for all submissions.

use std::sync::LazyLock;

use boon::{Compiler, SchemaIndex, Schemas};
use grader::score;
use serde_json::Value;

use crate::canary::Canaries;
use crate::entry::Entry;
use crate::run::GraderRun;

/// The maximum amount of memory that the grader itself may use, in bytes.
const MAX_MEMORY: u64 = 256 << 20;
/// The maximum number of files that the grader may have open at once: three streams, three for each
/// program that it has started, and those that it is reading or writing.
const MAX_OPEN_FILES: usize = 32;
/// Markup that entries print, which must never be on the page unescaped.
const MARKUP: &str = "<b id=forged>";

/// The start of the line that entries print if they reach something that they should not.
const REACHED_PREFIX: &str = "reached: ";

/// A check that failed.
#[derive(Debug)]
pub struct Violation {
    pub kind: ViolationKind,
    pub what: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViolationKind {
    /// The submission got points that it did not earn.
    Forged,
    /// A secret was found in the output, or a listener was contacted.
    Leaked,
    /// The system is not in the same state as before.
    LeftBehind,
    /// The grader did not work correctly.
    Harmed,
}

/// Returns all failed checks. If there is a `baseline`, the score must equal the baseline's.
pub fn violations(
    entry: &Entry,
    run: &GraderRun,
    baseline: Option<&GraderRun>,
    canaries: &Canaries,
    changes: Vec<String>,
) -> Vec<Violation> {
    let mut all = Vec::new();
    let mut found = |kind, what| all.push(Violation { kind, what });
    changes
        .into_iter()
        .for_each(|what| found(ViolationKind::LeftBehind, what));
    for listener in canaries.reached_listeners() {
        found(ViolationKind::Leaked, format!("{listener} was contacted"));
    }
    for text in [Some(&run.printed), run.score.as_ref(), run.page.as_ref()] {
        for secret in text.map_or(Vec::new(), |text| canaries.secrets_in(text)) {
            found(
                ViolationKind::Leaked,
                format!("the output contains the secret from {secret}"),
            );
        }
    }
    if let Some(line) = run
        .printed
        .lines()
        .find(|line| line.contains(REACHED_PREFIX))
    {
        found(ViolationKind::Leaked, line.trim().to_owned());
    }
    if run.elapsed > entry.wall() {
        found(ViolationKind::Harmed, format!("it took {:?}", run.elapsed));
    }
    if run.memory > MAX_MEMORY {
        let megabytes = run.memory >> 20;
        found(
            ViolationKind::Harmed,
            format!("the grader used {megabytes} MiB"),
        );
    }
    if run.open_files > MAX_OPEN_FILES {
        found(
            ViolationKind::Harmed,
            format!("the grader had {} files open", run.open_files),
        );
    }
    if let Some(why) = &entry.expect.refused {
        let is_refused = run.exit_code == Some(2) && run.printed.contains(why);
        if !is_refused || run.score.is_some() || !has_no_control_characters(&run.printed) {
            let (code, printed) = (run.exit_code, &run.printed);
            found(
                ViolationKind::Harmed,
                format!("not refused, {code:?}: {printed}"),
            );
        }
        return all;
    }
    if run.exit_code != Some(0) {
        let (code, printed) = (run.exit_code, &run.printed);
        found(
            ViolationKind::Harmed,
            format!("exit code {code:?}: {printed}"),
        );
        return all;
    }
    for what in report_problems(run) {
        found(ViolationKind::Harmed, what);
    }
    if let Some(says) = &entry.expect.says
        && !run.printed.contains(says)
    {
        found(
            ViolationKind::Harmed,
            format!("it does not say {says:?}:\n{}", run.printed),
        );
    }
    match run.reproducible_score() {
        Some(score) => check_points(entry, &score, &mut found),
        None => found(
            ViolationKind::Harmed,
            "there is no readable score".to_owned(),
        ),
    }
    if let Some(before) = baseline
        && before.reproducible_score() != run.reproducible_score()
    {
        found(
            ViolationKind::Harmed,
            "the reference is graded differently than before".to_owned(),
        );
    }
    all
}

/// Returns a message for each problem with the reports themselves.
fn report_problems(run: &GraderRun) -> Vec<String> {
    let mut problems = Vec::new();
    let score = run.score.as_deref().unwrap_or_default();
    let value: Value = serde_json::from_str(score).unwrap_or_default();
    if let Err(why) = SCHEMA.0.validate(&value, SCHEMA.1) {
        problems.push(format!("the score is not valid: {why}"));
    }
    if value["complete"] != true {
        problems.push("the score is not complete".to_owned());
    }
    if !has_no_control_characters(&run.printed) {
        problems.push("a control character reaches the terminal".to_owned());
    }
    let page = run.page.as_deref().unwrap_or_default();
    if page.contains(MARKUP) || !has_no_control_characters(page) || !page.ends_with("</html>") {
        problems.push("the page is not complete, or not escaped".to_owned());
    }
    if page.len() > 20 << 20 || score.len() > 2 << 20 || run.printed.len() > 1 << 20 {
        problems.push("a report is too long".to_owned());
    }
    problems
}

/// Returns whether a text has no control characters other than line breaks.
fn has_no_control_characters(text: &str) -> bool {
    !text.contains(|c: char| c.is_control() && c != '\n')
}

static SCHEMA: LazyLock<(Schemas, SchemaIndex)> = LazyLock::new(|| {
    let mut schemas = Schemas::new();
    let mut compiler = Compiler::new();
    let schema = serde_json::from_str(score::PUBLISHED_SCHEMA).expect("JSON");
    compiler
        .add_resource("score.json", schema)
        .expect("a schema");
    let index = compiler
        .compile("score.json", &mut schemas)
        .expect("a schema");
    (schemas, index)
});

/// Checks that each task has permitted points, and each item a permitted verdict.
fn check_points(entry: &Entry, score: &Value, found: &mut impl FnMut(ViolationKind, String)) {
    let tasks = score["tasks"].as_array();
    for task in tasks.into_iter().flatten() {
        let id = task["id"].as_str().unwrap_or_default();
        let points = task["points"].as_u64().unwrap_or_default();
        let expected = entry.base_points().find(|(task, _)| *task == id);
        let expected = expected.map_or(0, |(_, points)| points);
        match entry.expect.points.get(id) {
            None if points > expected => {
                found(
                    ViolationKind::Forged,
                    format!("{id}: {points} points instead of {expected}"),
                );
            }
            None if points < expected => {
                found(
                    ViolationKind::Harmed,
                    format!("{id}: {points} points instead of {expected}"),
                );
            }
            None => {}
            Some(most) => {
                if points > *most {
                    found(
                        ViolationKind::Forged,
                        format!("{id}: {points} points, at most {most}"),
                    );
                }
                check_verdicts(entry, task, found);
            }
        }
    }
}

fn check_verdicts(entry: &Entry, task: &Value, found: &mut impl FnMut(ViolationKind, String)) {
    for item in task["items"].as_array().into_iter().flatten() {
        let verdict = item["verdict"].as_str().unwrap_or_default();
        let allowed = entry.expect.verdicts.iter().any(|known| known == verdict);
        if verdict != "pass" && !allowed {
            let (id, why) = (&item["id"], &item["message"]);
            found(ViolationKind::Harmed, format!("{id} is {verdict}: {why}"));
        }
    }
}
