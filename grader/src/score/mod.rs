//! The score file: the result of grading, for people and programs. `cargo grade --schema` prints
//! its schema.
//!
//! The same submission, exam and toolchain always give the same bytes, except for `timings` and
//! `isolation`.

pub mod rerun_command;
pub mod stage_times;

use std::ops::Not;

use judging::assignment::Task;
use judging::exam_file::ExamName;
use judging::section::Section;
use judging::symptom::Symptom;
use serde::Serialize;

use crate::handed_out::{HandedOut, MethodPosition};
use crate::sandbox::Isolation;
use crate::score::rerun_command::RerunCommand;
use crate::score::stage_times::StageTimes;
use crate::workspace::book::Book;

/// Version of the format.
pub const SCHEMA_VERSION: u32 = 1;

/// The JSON schema of the format. It is committed so that graders don't need to compile `schemars`.
/// A test compares it with the types.
pub const PUBLISHED_SCHEMA: &str = include_str!("score.schema.json");

/// The score of one submission.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Score {
    /// Version of this format: 1.
    pub schema: u32,
    /// Name of the submission.
    pub submission: String,
    /// The exam.
    pub exam: ExamName,
    /// Isolation level of the submission.
    pub isolation: Isolation,
    /// Whether every item has been graded. False while the file is being written, or if the grader
    /// was stopped.
    pub complete: bool,
    /// Version of the bundle that students got. Absent if the grader is not from a bundle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bundle: Option<String>,
    /// The options to repeat in commands. Not stored in the file, whose contents must not depend on
    /// paths.
    #[serde(skip)]
    pub rerun_command: RerunCommand,
    /// The built handout on this machine, which the page links to. Not stored in the file.
    #[serde(skip)]
    pub book: Option<Book>,
    /// The title of the assignment, for the page. The score file stores the assignment's id
    /// instead.
    #[serde(skip)]
    pub assignment_title: &'static str,
    /// Sum of the points of all tasks.
    pub points: u32,
    /// Maximum number of points.
    pub max_points: u32,
    /// The tasks, in lecture order.
    pub tasks: Vec<TaskScore>,
    /// Compiler errors, and notes on the submission's files.
    pub build: BuildReport,
    /// Duration of grading. Not reproducible.
    pub timings: Timings,
}

/// The score of one task.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct TaskScore {
    /// Id of the task.
    pub id: Task,
    /// Title of the task.
    pub title: String,
    /// The chapter of the handout about the task, used for advice. Not stored in the file, where
    /// each item names its section.
    #[serde(skip)]
    pub chapter: Option<Section>,
    /// Sum of the points of its items.
    pub points: u32,
    /// Maximum number of points.
    pub max_points: u32,
    /// The items, in the order they were graded.
    pub items: Vec<ItemScore>,
    /// The task's method and its line, such as `sphere.rs:34`, or only the file if the method was
    /// not found. Used for advice. Not stored in the file.
    #[serde(skip)]
    pub method: String,
    /// The positions of the task's methods that were found. Used for advice. Not stored in the file.
    #[serde(skip)]
    pub methods: Vec<MethodPosition>,
    /// The compiler's warnings about the task's file, one line each. Not stored in the file.
    #[serde(skip)]
    pub warnings: Vec<String>,
    /// Beginning of what the submission printed during the task.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub printed: Option<String>,
}

/// The score of one item.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ItemScore {
    /// Id of the item, such as `sphere.from_inside`.
    pub id: String,
    /// Title of the item, which says what must hold.
    pub title: String,
    /// Points earned.
    pub points: u32,
    /// Maximum number of points.
    pub max_points: u32,
    /// Result of the item.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// For students: what happened, in one sentence. Empty if the item passed.
    pub message: String,
    /// Location of the failure in the submission's files, if the code panicked there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<CodeLocation>,
    /// For students: where to look. Only for failed items.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub look: Option<String>,
    /// For students: what to look for instead, if the way in which the item failed reveals it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clue: Option<String>,
    /// For students: what to look for instead if the item's own advice is about a different
    /// quantity from the one that is wrong.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub symptom_clue: Option<String>,
    /// For students: the section of the handout to read, such as `boxes.md#zero-and-minus-zero`.
    /// Only for failed items.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
    /// For students: the section to read instead, if the clue is explained elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clue_section: Option<Section>,
    /// The quantity that is wrong in the first wrong answer. Not stored in the file, since the
    /// item's message names it.
    #[serde(skip)]
    pub symptom: Option<Symptom>,
    /// The number of wrong answers and the number of all answers. Used for advice. Not stored in the
    /// file, since the item's message states both.
    #[serde(skip)]
    pub wrong_answers: Option<(usize, usize)>,
    /// The method of the task that gave the first wrong answer, or that gave none. Used for advice. Not
    /// stored in the file.
    #[serde(skip)]
    pub called: Option<&'static str>,
    /// For students: hints for the recognised mistake, or for several mistakes that give the same
    /// answers.
    pub hints: Vec<Hint>,
    /// For students: the first wrong answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Evidence>,
    /// Whether the item was graded with the reference's parts in place of the submission's other
    /// files, because an item that it depends on had failed.
    pub carried_forward: bool,
    /// Names of picture files beside this file.
    pub pictures: Vec<String>,
    /// Additional information for staff.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub staff: Option<String>,
}

/// A line in one of the submission's files.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct CodeLocation {
    /// File name, such as `sphere.rs`.
    pub file: String,
    /// Line number, counted from 1.
    pub line: u32,
}

impl CodeLocation {
    /// Parses the location of a panic, such as `sphere.rs:34:9`. Returns `None` if it is not in a
    /// task file.
    pub fn from_panic(location: &str, handed_out: &HandedOut) -> Option<Self> {
        let mut parts = location.split(':');
        let file = handed_out.task_file(parts.next()?)?;
        Some(CodeLocation {
            file: file.name.to_owned(),
            line: parts.next()?.parse().ok()?,
        })
    }
}

/// A hint for a known mistake.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Hint {
    /// A question that leads to the mistake.
    pub nudge: String,
    /// An explanation of the mistake.
    pub hint: String,
}

/// A question with the submission's answer and the expected one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Evidence {
    /// Number of the question in the item, counted from 1: `cargo grade --replay ITEM#NUMBER`.
    pub number: usize,
    /// The question.
    pub asked: String,
    /// The submission's answer.
    pub got: String,
    /// The expected answer.
    pub wanted: String,
    /// Whether the viewer has something to show for the question. Not stored in the file.
    #[serde(skip)]
    pub can_be_shown: bool,
}

/// Result of one item.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "verdict", rename_all = "snake_case")]
pub enum Verdict {
    /// All points.
    Pass,
    /// Some points.
    Partial,
    /// A wrong answer.
    Wrong,
    /// The code panicked.
    Panicked,
    /// The code is not written yet.
    Unimplemented,
    /// The time limit was exceeded.
    TimedOut,
    /// The memory limit was exceeded.
    OutOfMemory,
    /// The process ended unexpectedly.
    Crashed,
    /// The process sent invalid answers.
    Protocol,
    /// The file does not compile, or is missing.
    NotCompiled,
    /// The item depends on an item of another task that earned no points.
    Blocked {
        /// Id of the item that it depends on.
        by: String,
    },
    /// Not graded yet.
    Pending,
}

/// The kind of a verdict, for code that treats several verdicts alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VerdictKind {
    /// All points.
    Passed,
    /// An answer is wrong, or the code panicked: there is a mistake to find.
    Failed,
    /// The code is not written yet.
    Unwritten,
    /// The program ended, or had to be stopped, before it gave valid answers.
    NoAnswer,
    /// The file does not compile, or is missing.
    NotCompiled,
    /// The item depends on an item of another task that earned no points.
    Blocked,
    /// Not graded yet.
    Pending,
}

impl Verdict {
    /// Returns the kind of the verdict.
    pub fn kind(&self) -> VerdictKind {
        match self {
            Verdict::Pass => VerdictKind::Passed,
            Verdict::Partial | Verdict::Wrong | Verdict::Panicked => VerdictKind::Failed,
            Verdict::Unimplemented => VerdictKind::Unwritten,
            Verdict::TimedOut | Verdict::OutOfMemory | Verdict::Crashed | Verdict::Protocol => {
                VerdictKind::NoAnswer
            }
            Verdict::NotCompiled => VerdictKind::NotCompiled,
            Verdict::Blocked { .. } => VerdictKind::Blocked,
            Verdict::Pending => VerdictKind::Pending,
        }
    }

    /// Returns a human-readable label.
    pub fn label(&self) -> &'static str {
        match self {
            Verdict::Pass => "passed",
            Verdict::Partial => "partial",
            Verdict::Wrong => "wrong",
            Verdict::Panicked => "panicked",
            Verdict::Unimplemented => "not written yet",
            Verdict::TimedOut => "out of time",
            Verdict::OutOfMemory => "out of memory",
            Verdict::Crashed => "crashed",
            Verdict::Protocol => "no answer",
            Verdict::NotCompiled => "not compiled",
            Verdict::Blocked { .. } => "blocked",
            Verdict::Pending => "not graded yet",
        }
    }
}

/// Compiler errors, and notes on the submission's files.
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct BuildReport {
    /// Files that could not be used, and were replaced with the starter's versions.
    pub not_compiled: Vec<FileReport>,
    /// Notes on files that look like task files or archives but were not graded or are misnamed.
    pub ignored_copies: Vec<String>,
    /// Other notes that do not affect points.
    pub notes: Vec<String>,
}

impl BuildReport {
    /// Returns all notes, starting with those on files that were not graded.
    pub fn all_notes(&self) -> impl Iterator<Item = &String> + Clone {
        self.ignored_copies.iter().chain(&self.notes)
    }
}

/// A file that could not be used.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct FileReport {
    /// File name, such as `sphere.rs`.
    pub file: String,
    /// Line of the compiler's first error in the file, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// The compiler's errors in the file, or why the file could not be read.
    pub message: String,
    /// Whether the submission doesn't contain the file.
    #[serde(rename = "missing", skip_serializing_if = "Not::not")]
    #[cfg_attr(test, schemars(default))]
    pub is_missing: bool,
}

/// Duration of grading, in milliseconds.
#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Timings {
    /// Time to build the probe.
    pub build_ms: u64,
    /// Time to run the exam.
    pub exam_ms: u64,
    /// Details for `--timings`. Not stored in the file.
    #[serde(skip)]
    pub stages: StageTimes,
}

impl TaskScore {
    /// If an answer is wrong or missing, returns the warnings, which may explain why.
    pub fn relevant_warnings(&self) -> &[String] {
        let mut kinds = self.items.iter().map(|item| item.verdict.kind());
        let is_wrong =
            kinds.any(|kind| matches!(kind, VerdictKind::Failed | VerdictKind::NoAnswer));
        if is_wrong { &self.warnings } else { &[] }
    }
}

impl ItemScore {
    /// Creates the score of an item that is not graded yet.
    pub fn pending(id: &str, title: &str, max_points: u32) -> Self {
        ItemScore {
            id: id.to_owned(),
            title: title.to_owned(),
            points: 0,
            max_points,
            verdict: Verdict::Pending,
            message: String::new(),
            at: None,
            look: None,
            clue: None,
            section: None,
            symptom_clue: None,
            clue_section: None,
            symptom: None,
            wrong_answers: None,
            called: None,
            hints: Vec::new(),
            evidence: None,
            carried_forward: false,
            pictures: Vec::new(),
            staff: None,
        }
    }

    /// Returns whether the answers are wrong and no hint or clue says more about them.
    pub fn has_no_clue(&self) -> bool {
        self.verdict.kind() == VerdictKind::Failed && self.hints.is_empty() && self.clue.is_none()
    }

    /// Returns the text that says where to look: the clue from this failure or, failing that, the
    /// item's own text. If there is a hint, the item's own text is left out, since it may be about
    /// another part of the code.
    pub fn where_to_look(&self) -> Option<&String> {
        let other = self.symptom_clue.as_ref().or(self.look.as_ref());
        self.clue
            .as_ref()
            .or(other.filter(|_| self.hints.is_empty()))
    }

    /// Returns the section to read, which explains where to look.
    pub fn where_to_read(&self) -> Option<&Section> {
        self.clue_section.as_ref().or(self.section.as_ref())
    }

    /// Returns the rows that describe the item in text reports, each with a label and some text.
    /// Rows without text are left out. The report chooses the wording of the message and the hints.
    pub fn rows(&self, what: String, hint: Option<String>) -> Vec<(&'static str, String)> {
        let evidence = |text: fn(&Evidence) -> &String| self.evidence.as_ref().map(text).cloned();
        let rows = [
            ("what", Some(what)),
            ("asked", evidence(|evidence| &evidence.asked)),
            ("got", evidence(|evidence| &evidence.got)),
            ("wanted", evidence(|evidence| &evidence.wanted)),
            ("look", self.where_to_look().cloned()),
            ("hint", hint),
            ("read", self.where_to_read().map(Section::location)),
        ];
        let rows = rows
            .into_iter()
            .filter_map(|(label, text)| Some((label, text?)));
        rows.filter(|(_, text)| !text.is_empty()).collect()
    }

    /// Returns the command that reruns only the question in the item's evidence or, if there is no
    /// evidence, the whole task.
    pub fn rerun_command(&self, command: &RerunCommand) -> String {
        match &self.evidence {
            Some(evidence) => command.replay(&self.id, evidence.number),
            None => command.task(self.id.split('.').next().unwrap_or_default()),
        }
    }

    /// Returns the command that shows the question from the evidence in the viewer, if there is
    /// one.
    pub fn view_command(&self, command: &RerunCommand) -> Option<String> {
        let evidence = self.evidence.as_ref()?;
        let number = evidence.can_be_shown.then_some(evidence.number)?;
        command.view(&self.id, number)
    }
}

impl Score {
    /// Returns all items, in grading order.
    pub fn items(&self) -> impl Iterator<Item = &ItemScore> {
        self.tasks.iter().flat_map(|task| &task.items)
    }

    /// Returns the text of the score file.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self);
        text.expect("all map keys in a score are strings") + "\n"
    }

    /// Replaces the score of the item with the same id.
    pub fn record(&mut self, line: ItemScore) {
        let mut items = self.tasks.iter_mut().flat_map(|task| &mut task.items);
        if let Some(item) = items.find(|item| item.id == line.id) {
            *item = line;
        }
    }

    /// Adds up the points of all tasks.
    pub fn update_totals(&mut self) {
        for task in &mut self.tasks {
            task.points = task.items.iter().map(|item| item.points).sum();
        }
        self.points = self.tasks.iter().map(|task| task.points).sum();
    }
}

#[cfg(test)]
pub(crate) mod tests;
