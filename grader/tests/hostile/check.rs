//! What must hold after every run, whatever was graded.

use std::sync::LazyLock;

use boon::{Compiler, SchemaIndex, Schemas};
use grader::score;
use serde_json::Value;

use crate::canary::Canaries;
use crate::entry::Entry;
use crate::run::Run;

/// The most memory that the grader itself may take, in bytes.
const MEMORY: u64 = 256 << 20;
/// The most files that it may have open at once. Three streams, three for each program that it has
/// started, and what it reads or writes just then.
const FILES: usize = 32;
/// Stands in what entries print and must never reach a page as it is.
const MARKUP: &str = "<b id=forged>";

/// What entries print where they reach what they should not.
const REACHED: &str = "reached: ";

/// Something that did not hold.
#[derive(Debug)]
pub struct Broken {
    pub finding: Finding,
    pub what: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finding {
    /// Points for nothing.
    Forged,
    /// A secret came out, or somebody was told.
    Leaked,
    /// Something is there that was not.
    Left,
    /// The grader did not do its own work.
    Harmed,
}

/// All that did not hold.
pub fn broken(
    entry: &Entry,
    run: &Run,
    as_before: Option<&Run>,
    canaries: &Canaries,
    came: Vec<String>,
) -> Vec<Broken> {
    let mut all = Vec::new();
    let mut found = |finding, what| all.push(Broken { finding, what });
    came.into_iter().for_each(|what| found(Finding::Left, what));
    for place in canaries.reached() {
        found(Finding::Leaked, format!("{place} was reached"));
    }
    for text in [Some(&run.printed), run.score.as_ref(), run.page.as_ref()] {
        for secret in text.map_or(Vec::new(), |text| canaries.found_in(text)) {
            found(Finding::Leaked, format!("a secret of {secret} came out"));
        }
    }
    if let Some(line) = run.printed.lines().find(|line| line.contains(REACHED)) {
        found(Finding::Leaked, line.trim().to_owned());
    }
    if run.took > entry.wall() {
        found(Finding::Harmed, format!("it took {:?}", run.took));
    }
    if run.memory > MEMORY {
        let megabytes = run.memory >> 20;
        found(Finding::Harmed, format!("the grader took {megabytes} MiB"));
    }
    if run.files > FILES {
        found(
            Finding::Harmed,
            format!("the grader had {} files open", run.files),
        );
    }
    if let Some(why) = &entry.expect.refused {
        let is_refused = run.exit_code == Some(2) && run.printed.contains(why);
        if !is_refused || run.score.is_some() || !is_tame(&run.printed) {
            let (code, printed) = (run.exit_code, &run.printed);
            found(Finding::Harmed, format!("not refused, {code:?}: {printed}"));
        }
        return all;
    }
    if run.exit_code != Some(0) {
        let (code, printed) = (run.exit_code, &run.printed);
        found(Finding::Harmed, format!("exit code {code:?}: {printed}"));
        return all;
    }
    for what in unfit(run) {
        found(Finding::Harmed, what);
    }
    if let Some(says) = &entry.expect.says
        && !run.printed.contains(says)
    {
        found(
            Finding::Harmed,
            format!("it does not say {says:?}:\n{}", run.printed),
        );
    }
    match run.lasting() {
        Some(score) => points(entry, &score, &mut found),
        None => found(
            Finding::Harmed,
            "there is no score that can be read".to_owned(),
        ),
    }
    if let Some(before) = as_before
        && before.lasting() != run.lasting()
    {
        found(
            Finding::Harmed,
            "honest work is graded otherwise than before".to_owned(),
        );
    }
    all
}

/// What is wrong with the reports themselves.
fn unfit(run: &Run) -> Vec<String> {
    let mut unfit = Vec::new();
    let score = run.score.as_deref().unwrap_or_default();
    let value: Value = serde_json::from_str(score).unwrap_or_default();
    if let Err(why) = SCHEMA.0.validate(&value, SCHEMA.1) {
        unfit.push(format!("the score is not valid: {why}"));
    }
    if value["complete"] != true {
        unfit.push("the score is not complete".to_owned());
    }
    if !is_tame(&run.printed) {
        unfit.push("a control character reaches the terminal".to_owned());
    }
    let page = run.page.as_deref().unwrap_or_default();
    if page.contains(MARKUP) || !is_tame(page) || !page.ends_with("</html>") {
        unfit.push("the page is not whole, or not escaped".to_owned());
    }
    if page.len() > 20 << 20 || score.len() > 2 << 20 || run.printed.len() > 1 << 20 {
        unfit.push("a report is as long as a submission likes".to_owned());
    }
    unfit
}

/// Whether nothing in it moves on a terminal.
fn is_tame(text: &str) -> bool {
    !text.contains(|c: char| c.is_control() && c != '\n')
}

static SCHEMA: LazyLock<(Schemas, SchemaIndex)> = LazyLock::new(|| {
    let mut schemas = Schemas::new();
    let mut compiler = Compiler::new();
    let schema = serde_json::from_str(score::PUBLISHED).expect("JSON");
    compiler
        .add_resource("score.json", schema)
        .expect("a schema");
    let index = compiler
        .compile("score.json", &mut schemas)
        .expect("a schema");
    (schemas, index)
});

/// Whether each task has the points that it may have, and each item such a verdict.
fn points(entry: &Entry, score: &Value, found: &mut impl FnMut(Finding, String)) {
    let tasks = score["tasks"].as_array();
    for task in tasks.into_iter().flatten() {
        let id = task["id"].as_str().unwrap_or_default();
        let points = task["points"].as_u64().unwrap_or_default();
        let honest = entry
            .honest_points()
            .into_iter()
            .find(|(task, _)| *task == id);
        let honest = honest.map_or(0, |(_, points)| points);
        match entry.expect.points.get(id) {
            None if points > honest => {
                found(
                    Finding::Forged,
                    format!("{id}: {points} points instead of {honest}"),
                );
            }
            None if points < honest => {
                found(
                    Finding::Harmed,
                    format!("{id}: {points} points instead of {honest}"),
                );
            }
            None => {}
            Some(most) => {
                if points > *most {
                    found(
                        Finding::Forged,
                        format!("{id}: {points} points, at most {most}"),
                    );
                }
                verdicts(entry, task, found);
            }
        }
    }
}

fn verdicts(entry: &Entry, task: &Value, found: &mut impl FnMut(Finding, String)) {
    for item in task["items"].as_array().into_iter().flatten() {
        let verdict = item["verdict"].as_str().unwrap_or_default();
        let allowed = entry.expect.verdicts.iter().any(|known| known == verdict);
        if verdict != "pass" && !allowed {
            let (id, why) = (&item["id"], &item["message"]);
            found(Finding::Harmed, format!("{id} is {verdict}: {why}"));
        }
    }
}
