//! The checks that follow every run. They are the same for all submissions.

use std::sync::LazyLock;

use boon::{Compiler, SchemaIndex, Schemas};
use grader::score;
use serde_json::Value;

use crate::canary::Canaries;
use crate::entry::Entry;
use crate::run::GraderRun;

/// The maximum memory that the grader itself may use, in bytes.
const MAX_MEMORY: u64 = 256 << 20;
/// The maximum number of files that the grader may have open at once: three streams, three for each
/// program it has started, and the files it is reading or writing.
const MAX_OPEN_FILES: usize = 32;
/// Markup that entries print and that must never appear unescaped on the page.
const MARKUP: &str = "<b id=forged>";

/// The start of the line that entries print if they reach something they shouldn't.
const REACHED_PREFIX: &str = "reached: ";

/// A check that failed.
#[derive(Debug)]
pub struct Violation {
    pub kind: ViolationKind,
    pub what: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViolationKind {
    /// The submission got points it didn't earn.
    Forged,
    /// A secret was found in the output, or a listener was contacted.
    Leaked,
    /// The system isn't in the same state as before.
    LeftBehind,
    /// The grader didn't work correctly.
    Harmed,
}

impl Violation {
    fn new(kind: ViolationKind, what: String) -> Self {
        Violation { kind, what }
    }
}

/// Returns all failed checks. If there is a `baseline`, the score must equal the baseline's.
pub fn violations(
    entry: &Entry,
    run: &GraderRun,
    baseline: Option<&GraderRun>,
    canaries: &Canaries,
    changes: Vec<String>,
) -> Vec<Violation> {
    let of = |kind| move |what| Violation::new(kind, what);
    let left = changes.into_iter().map(of(ViolationKind::LeftBehind));
    let leaked = leaks(run, canaries).into_iter();
    let mut all: Vec<Violation> = left.chain(leaked.map(of(ViolationKind::Leaked))).collect();
    let mut harms = excesses(entry, run);
    let (code, printed) = (run.exit_code, &run.printed);
    match &entry.expect.refused {
        Some(why) => {
            let is_refused = code == Some(2) && printed.contains(why) && run.score.is_none();
            if !is_refused || !has_no_control_characters(printed) {
                harms.push(format!("not refused, {code:?}: {printed}"));
            }
        }
        None if code != Some(0) => harms.push(format!("exit code {code:?}: {printed}")),
        None => {
            harms.extend(report_problems(run));
            let says = entry.expect.says.iter();
            let missing = says.filter(|says| !printed.contains(*says));
            harms.extend(missing.map(|says| format!("it does not say {says:?}:\n{printed}")));
            match run.reproducible_score() {
                Some(score) => all.extend(wrong_points(entry, &score)),
                None => harms.push("there is no readable score".to_owned()),
            }
            let is_as_before =
                |before: &GraderRun| before.reproducible_score() == run.reproducible_score();
            if !baseline.is_none_or(is_as_before) {
                harms.push("the reference is graded differently than before".to_owned());
            }
        }
    }
    all.extend(harms.into_iter().map(of(ViolationKind::Harmed)));
    all
}

/// Returns a message for each secret in the output, each line that says that something was reached,
/// and each listener that was contacted.
fn leaks(run: &GraderRun, canaries: &Canaries) -> Vec<String> {
    let listeners = canaries.reached_listeners().into_iter();
    let contacted = listeners.map(|listener| format!("{listener} was contacted"));
    let texts = [Some(&run.printed), run.score.as_ref(), run.page.as_ref()];
    let secrets = texts.into_iter().flatten();
    let secrets = secrets.flat_map(|text| canaries.secrets_in(text));
    let secrets = secrets.map(|secret| format!("the output contains the secret from {secret}"));
    let mut lines = run.printed.lines();
    let reached = lines.find(|line| line.contains(REACHED_PREFIX));
    let reached = reached.map(|line| line.trim().to_owned());
    contacted.chain(secrets).chain(reached).collect()
}

/// Returns a message for each limit on time, memory or open files that the grader exceeded.
fn excesses(entry: &Entry, run: &GraderRun) -> Vec<String> {
    let mut excesses = Vec::new();
    if run.elapsed > entry.wall() {
        excesses.push(format!("it took {:?}", run.elapsed));
    }
    if run.memory > MAX_MEMORY {
        excesses.push(format!("the grader used {} MiB", run.memory >> 20));
    }
    if run.open_files > MAX_OPEN_FILES {
        excesses.push(format!("the grader had {} files open", run.open_files));
    }
    excesses
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

/// Returns whether text contains no control characters other than line breaks.
fn has_no_control_characters(text: &str) -> bool {
    !text.contains(|c: char| c.is_control() && c != '\n')
}

static SCHEMA: LazyLock<(Schemas, SchemaIndex)> = LazyLock::new(|| {
    let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
    let schema = serde_json::from_str(score::PUBLISHED_SCHEMA).expect("JSON");
    let added = compiler.add_resource("score.json", schema);
    added.expect("a schema");
    let index = compiler.compile("score.json", &mut schemas);
    (schemas, index.expect("a schema"))
});

/// Returns a violation for each task whose points aren't permitted, and for each item whose verdict
/// isn't permitted.
fn wrong_points(entry: &Entry, score: &Value) -> Vec<Violation> {
    let mut wrong = Vec::new();
    for task in score["tasks"].as_array().into_iter().flatten() {
        let id = task["id"].as_str().unwrap_or_default();
        let points = task["points"].as_u64().unwrap_or_default();
        let expected = entry.base_points().find(|(task, _)| *task == id);
        let expected = expected.map_or(0, |(_, points)| points);
        let (most, limit) = match entry.expect.points.get(id) {
            Some(most) => (*most, format!(", at most {most}")),
            None => (expected, format!(" instead of {expected}")),
        };
        let what = format!("{id}: {points} points{limit}");
        let is_affected = entry.expect.points.contains_key(id);
        if points > most {
            wrong.push(Violation::new(ViolationKind::Forged, what));
        } else if points < most && !is_affected {
            wrong.push(Violation::new(ViolationKind::Harmed, what));
        }
        if is_affected {
            wrong.extend(wrong_verdicts(entry, task));
        }
    }
    wrong
}

fn wrong_verdicts(entry: &Entry, task: &Value) -> Vec<Violation> {
    let items = task["items"].as_array().into_iter().flatten();
    let wrong = items.filter_map(|item| {
        let verdict = item["verdict"].as_str().unwrap_or_default();
        let allowed = entry.expect.verdicts.iter().any(|known| known == verdict);
        let (id, why) = (&item["id"], &item["message"]);
        let what = format!("{id} is {verdict}: {why}");
        (verdict != "pass" && !allowed).then(|| Violation::new(ViolationKind::Harmed, what))
    });
    wrong.collect()
}
