//! What must hold after every run, whatever was graded.

use std::sync::LazyLock;

use boon::{Compiler, SchemaIndex, Schemas};
use grader::score;
use serde_json::Value;

use crate::canary::Canaries;
use crate::entry::Entry;
use crate::run::GraderRun;

/// The most memory that the grader itself may take, in bytes.
const MAX_MEMORY: u64 = 256 << 20;
/// The most files that it may have open at once. Three streams, three for each program that it has
/// started, and what it reads or writes just then.
const MAX_OPEN_FILES: usize = 32;
/// Stands in what entries print and must never reach a page as it is.
const MARKUP: &str = "<b id=forged>";

/// What entries print where they reach what they should not.
const REACHED_PREFIX: &str = "reached: ";

/// Something that did not hold.
#[derive(Debug)]
pub struct Violation {
    pub kind: ViolationKind,
    pub what: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViolationKind {
    /// Points for nothing.
    Forged,
    /// A secret came out, or somebody was told.
    Leaked,
    /// Something is there that was not.
    LeftBehind,
    /// The grader did not do its own work.
    Harmed,
}

/// All that did not hold.
pub fn violations(
    entry: &Entry,
    run: &GraderRun,
    as_before: Option<&GraderRun>,
    canaries: &Canaries,
    came: Vec<String>,
) -> Vec<Violation> {
    let mut all = Vec::new();
    let mut found = |finding, what| {
        all.push(Violation {
            kind: finding,
            what,
        })
    };
    came.into_iter()
        .for_each(|what| found(ViolationKind::LeftBehind, what));
    for place in canaries.reached_listeners() {
        found(ViolationKind::Leaked, format!("{place} was reached"));
    }
    for text in [Some(&run.printed), run.score.as_ref(), run.page.as_ref()] {
        for secret in text.map_or(Vec::new(), |text| canaries.secrets_in(text)) {
            found(
                ViolationKind::Leaked,
                format!("a secret of {secret} came out"),
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
            format!("the grader took {megabytes} MiB"),
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
            "there is no score that can be read".to_owned(),
        ),
    }
    if let Some(before) = as_before
        && before.reproducible_score() != run.reproducible_score()
    {
        found(
            ViolationKind::Harmed,
            "honest work is graded otherwise than before".to_owned(),
        );
    }
    all
}

/// What is wrong with the reports themselves.
fn report_problems(run: &GraderRun) -> Vec<String> {
    let mut unfit = Vec::new();
    let score = run.score.as_deref().unwrap_or_default();
    let value: Value = serde_json::from_str(score).unwrap_or_default();
    if let Err(why) = SCHEMA.0.validate(&value, SCHEMA.1) {
        unfit.push(format!("the score is not valid: {why}"));
    }
    if value["complete"] != true {
        unfit.push("the score is not complete".to_owned());
    }
    if !has_no_control_characters(&run.printed) {
        unfit.push("a control character reaches the terminal".to_owned());
    }
    let page = run.page.as_deref().unwrap_or_default();
    if page.contains(MARKUP) || !has_no_control_characters(page) || !page.ends_with("</html>") {
        unfit.push("the page is not whole, or not escaped".to_owned());
    }
    if page.len() > 20 << 20 || score.len() > 2 << 20 || run.printed.len() > 1 << 20 {
        unfit.push("a report is as long as a submission likes".to_owned());
    }
    unfit
}

/// Whether nothing in it moves on a terminal.
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

/// Whether each task has the points that it may have, and each item such a verdict.
fn check_points(entry: &Entry, score: &Value, found: &mut impl FnMut(ViolationKind, String)) {
    let tasks = score["tasks"].as_array();
    for task in tasks.into_iter().flatten() {
        let id = task["id"].as_str().unwrap_or_default();
        let points = task["points"].as_u64().unwrap_or_default();
        let honest = entry
            .base_points()
            .into_iter()
            .find(|(task, _)| *task == id);
        let honest = honest.map_or(0, |(_, points)| points);
        match entry.expect.points.get(id) {
            None if points > honest => {
                found(
                    ViolationKind::Forged,
                    format!("{id}: {points} points instead of {honest}"),
                );
            }
            None if points < honest => {
                found(
                    ViolationKind::Harmed,
                    format!("{id}: {points} points instead of {honest}"),
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
