//! Options for grading, independent of the command line.

use std::path::PathBuf;

use crate::build::select_isolation::IsolationRequest;
use crate::format::OutputSpec;
use crate::handed_out::HandedOut;
use crate::inputs::exam_source::ExamSource;
use crate::inputs::task_selection::TaskSelection;
use crate::probe::Budget;
use crate::report::text::HintDetail;

/// Options for grading a submission. The default is a student's own work on the practice exam.
///
/// Code that depends on all options, e.g. to compute a cache key, destructures this type without
/// `..`, so that a new option cannot be forgotten there.
#[derive(Clone, Debug)]
pub struct GradeOptions {
    /// The assignment.
    pub handed_out: &'static HandedOut,
    /// The submission's folder or archive, or `None` for the student's own work.
    pub submission: Option<PathBuf>,
    /// The exam to grade the submission with.
    pub exam: ExamSource,
    /// The tasks to grade.
    pub tasks: TaskSelection,
    /// The course's policy file, or `None` for the default policy.
    pub policy: Option<PathBuf>,
    /// Gradescope's `submission_metadata.json`, which contains the submission time.
    pub gradescope_metadata: Option<PathBuf>,
    /// The treatment of items that depend on a failed task.
    pub dependents: Dependents,
    /// The requested isolation for the submission's code.
    pub isolation: IsolationRequest,
    /// The time budget for an item.
    pub budget: Budget,
    /// The level of detail of hints.
    pub hints: HintDetail,
    /// The folder for the report. `None` means `target/grade/NAME`.
    pub out: Option<PathBuf>,
    /// The requested output formats.
    pub formats: Vec<OutputSpec>,
}

impl GradeOptions {
    /// Returns the value of `--assignment` in a command that repeats the grading, or `None` if the
    /// option isn't needed because the exam file determines the assignment or because it is the
    /// default assignment.
    pub fn assignment_option(&self) -> Option<&'static str> {
        let is_default = self.handed_out == <&HandedOut>::default();
        let is_chosen = self.exam == ExamSource::Practice && !is_default;
        is_chosen.then_some(self.handed_out.assignment.id)
    }
}

impl Default for GradeOptions {
    fn default() -> Self {
        GradeOptions {
            handed_out: Default::default(),
            submission: None,
            exam: ExamSource::default(),
            tasks: TaskSelection::All,
            policy: None,
            gradescope_metadata: None,
            dependents: Dependents::default(),
            isolation: IsolationRequest::default(),
            budget: Budget::default(),
            hints: HintDetail::default(),
            out: None,
            formats: Vec::new(),
        }
    }
}

/// The treatment of items that depend on a failed task.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dependents {
    /// Grade them with the reference's parts, if the reference is in the workspace.
    #[default]
    SubstituteReference,
    /// Block them, as happens on a student's machine.
    Block,
}

impl Dependents {
    /// Returns the treatment that the flag `--no-reference` selects.
    pub fn new(no_reference: bool) -> Self {
        if no_reference {
            Dependents::Block
        } else {
            Dependents::SubstituteReference
        }
    }
}
