//! The score file: what everyone reads, from a terminal to a learning platform. Its schema is
//! published by `cargo grade --schema`.
//!
//! The same submission, exam and toolchain give the same bytes, but for `timings`, `isolation`.

use serde::Serialize;

use crate::exam::Task;
use crate::exam_file::ExamName;
use crate::given_files::TASK_FILES;
use crate::rerun_command::RerunCommand;
use crate::sandbox::Isolation;
use crate::section::Section;
use crate::stage_times::StageTimes;

/// The version of this format.
pub const SCHEMA_VERSION: u32 = 1;

/// The format, as a JSON schema. Committed, and compared with the types by a test: whoever grades
/// need not compile what derives it.
pub const PUBLISHED_SCHEMA: &str = include_str!("score.schema.json");

/// One submission, graded.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Score {
    /// The version of this format: 1.
    pub schema: u32,
    /// The submission's name.
    pub submission: String,
    /// What was asked.
    pub exam: ExamName,
    /// How submissions were kept apart from this machine.
    pub isolation: Isolation,
    /// Whether everything has been asked. False in a file that is still being written, or whose
    /// grader was stopped.
    pub complete: bool,
    /// How to ask the same once more. Not in the file, which is the same wherever it is made.
    #[serde(skip)]
    pub rerun_command: RerunCommand,
    /// The sum over all tasks.
    pub points: u32,
    /// The most points that could be had.
    pub max_points: u32,
    /// In lecture order.
    pub tasks: Vec<TaskScore>,
    /// What the compiler and the grader had to say of the files.
    pub build: BuildReport,
    /// How long it took. Not reproducible.
    pub timings: Timings,
}

/// One task's items.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct TaskScore {
    /// Which.
    pub id: Task,
    /// What people read.
    pub title: String,
    /// The sum over its items.
    pub points: u32,
    /// The most points that could be had.
    pub max_points: u32,
    /// In the order of asking.
    pub items: Vec<ItemScore>,
    /// What the submission printed while it was asked, the beginning of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub printed: Option<String>,
}

/// One item, judged.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ItemScore {
    /// Such as `sphere.from_inside`.
    pub id: String,
    /// What must hold, in words.
    pub title: String,
    /// What it earned.
    pub points: u32,
    /// What it is worth.
    pub max_points: u32,
    /// What became of it.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// For students: what happened, in a sentence. Empty if all is well.
    pub message: String,
    /// Where in the submission's files it went wrong, if the code itself says so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<CodeLocation>,
    /// For students: where to look. Only where something is wrong.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub look: Option<String>,
    /// For students: the section of the handout that teaches it, such as
    /// `boxes.md#zero-and-minus-zero`. Only where something is wrong.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
    /// For students: the known mistake that answers the same; several if nothing tells them apart.
    pub hints: Vec<Hint>,
    /// For students: the first thing that went wrong.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Evidence>,
    /// Whether this is what came of asking again, with right parts in the place of the
    /// submission's other files, because one of those had failed.
    pub carried_forward: bool,
    /// Files beside this one that show it.
    pub pictures: Vec<String>,
    /// For staff only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub staff: Option<String>,
}

/// A line of one of the five files.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct CodeLocation {
    /// Such as `sphere.rs`.
    pub file: String,
    /// Counted from 1.
    pub line: u32,
}

impl CodeLocation {
    /// The place that a panic names, such as `sphere.rs:34`. None if it is in no submission's file.
    pub fn from_panic(place: &str) -> Option<Self> {
        let mut parts = place.split(':');
        let file = parts.next()?;
        let file = TASK_FILES.iter().find(|known| known.name == file)?;
        Some(CodeLocation {
            file: file.name.to_owned(),
            line: parts.next()?.parse().ok()?,
        })
    }
}

/// What a known mistake would do well to hear.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Hint {
    /// A question that leads there.
    pub nudge: String,
    /// What is wrong.
    pub hint: String,
}

/// What was asked, what came, what should have come.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Evidence {
    /// Which question of the item, counted from 1: `cargo grade --replay ITEM#NUMBER`.
    pub number: usize,
    /// The question.
    pub asked: String,
    /// The submission's answer.
    pub got: String,
    /// The right one.
    pub wanted: String,
}

/// What became of one item.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "verdict", rename_all = "snake_case")]
pub enum Verdict {
    /// All points.
    Pass,
    /// Some points.
    Partial,
    /// An answer that is not right.
    Wrong,
    /// The code panicked.
    Panicked,
    /// The code is not written yet.
    Unimplemented,
    /// No answer in time.
    TimedOut,
    /// The code used more memory than there is.
    OutOfMemory,
    /// The process ended.
    Crashed,
    /// What came back was no answer.
    Protocol,
    /// The file does not compile, or is not there.
    NotCompiled,
    /// It rests on another task, which earned nothing.
    Blocked {
        /// The item that it needs.
        by: String,
    },
    /// Not asked yet.
    Pending,
}

impl Verdict {
    /// What people read.
    pub fn label(&self) -> &'static str {
        match self {
            Verdict::Pass => "passed",
            Verdict::Partial => "in part",
            Verdict::Wrong => "wrong",
            Verdict::Panicked => "panicked",
            Verdict::Unimplemented => "not written yet",
            Verdict::TimedOut => "out of time",
            Verdict::OutOfMemory => "out of memory",
            Verdict::Crashed => "crashed",
            Verdict::Protocol => "no answer",
            Verdict::NotCompiled => "not compiled",
            Verdict::Blocked { .. } => "blocked",
            Verdict::Pending => "not asked yet",
        }
    }
}

/// What the compiler and the grader had to say of the files.
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct BuildReport {
    /// The files in whose place the starter's was taken.
    pub not_compiled: Vec<FileReport>,
    /// What is worth knowing and costs nothing.
    pub notes: Vec<String>,
}

/// One file that could not be used.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct FileReport {
    /// Such as `sphere.rs`.
    pub file: String,
    /// The line of that error, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// The compiler's first error in it, or why there is no text.
    pub message: String,
}

/// How long it took, in milliseconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Timings {
    /// From files to a probe.
    pub build_ms: u64,
    /// Asking and judging.
    pub exam_ms: u64,
    /// In detail, for `--timings`: not in the file.
    #[serde(skip)]
    pub stages: StageTimes,
}

impl ItemScore {
    /// The command that asks the same again: one question where there is one to speak of, else
    /// the task.
    pub fn rerun_command(&self, again: &RerunCommand) -> String {
        match &self.evidence {
            Some(evidence) => again.replay(&self.id, evidence.number),
            None => again.task(self.id.split('.').next().unwrap_or_default()),
        }
    }
}

impl Score {
    /// All items, in the order of asking.
    pub fn items(&self) -> impl Iterator<Item = &ItemScore> {
        self.tasks.iter().flat_map(|task| &task.items)
    }

    /// Puts a line in the place of the one with the same id.
    pub fn record(&mut self, line: ItemScore) {
        let mut items = self.tasks.iter_mut().flat_map(|task| &mut task.items);
        if let Some(place) = items.find(|item| item.id == line.id) {
            *place = line;
        }
    }

    /// Adds up.
    pub fn update_totals(&mut self) {
        for task in &mut self.tasks {
            task.points = task.items.iter().map(|item| item.points).sum();
        }
        self.points = self.tasks.iter().map(|task| task.points).sum();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_schema_matches_the_types() {
        let schema = schemars::schema_for!(Score);
        let schema = format!("{:#}\n", schema.as_value());
        if std::env::var_os("INSTA_UPDATE").is_some_and(|what| what == "always") {
            let place = concat!(env!("CARGO_MANIFEST_DIR"), "/src/score.schema.json");
            std::fs::write(place, &schema).unwrap();
        }
        assert_eq!(
            PUBLISHED_SCHEMA, schema,
            "`INSTA_UPDATE=always cargo test -p grader --lib schema` writes it anew"
        );
    }
}
