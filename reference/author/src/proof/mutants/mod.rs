//! Checks that the exam catches every mechanical change to the reference's task files: the mutants of
//! cargo-mutants, and the systematic mistakes. Each must lose points, except those that are
//! equivalent to the reference.

pub mod findings;

use std::path::Path;

use grader::exam_source::ExamSourceError;
use grader::files::{self, PathError};
use grader::handed_out::HandedOut;
use indicatif::ParallelProgressIterator;
use judging::exam::Exam;
use rayon::prelude::*;

use crate::exams;
use crate::generated_file::Mode;
use crate::proof::mutants::findings::{Findings, MutantOutcome};
use crate::proof::progress::progress_bar;
use crate::solutions::mutants::cargo_mutants::{self, CargoMutantsError};
use crate::solutions::mutants::equivalent::{self, EquivalentsError, equivalent_mutants};
use crate::solutions::mutants::list::{self, MutantList, OutdatedListError};
use crate::solutions::sources::Sources;
use crate::solutions::systematic::systematic_mistakes;
use crate::solutions::workbench::{Workbench, WorkbenchError};

/// The step of a sample: it contains one in this many mutants, in the order of their names.
const SAMPLE_STEP: usize = 8;

/// The reason why the mutants cannot be graded.
#[derive(Debug, thiserror::Error)]
pub enum MutantsError {
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// The list of cargo-mutants cannot be used.
    #[error(transparent)]
    CargoMutants(#[from] CargoMutantsError),
    /// The committed list is invalid.
    #[error(
        "{path}: {0}; install cargo-mutants and run `cargo author mutants`",
        path = list::PATH
    )]
    CommittedList(#[from] serde_json::Error),
    /// The committed list is out of date.
    #[error(transparent)]
    OutdatedList(#[from] OutdatedListError),
    /// The list of equivalent mutants cannot be used.
    #[error(transparent)]
    Equivalents(#[from] EquivalentsError),
    /// The practice exam cannot be used.
    #[error(transparent)]
    Exam(#[from] ExamSourceError),
    /// A mutant cannot be built or run.
    #[error(transparent)]
    Workbench(#[from] WorkbenchError),
    /// The reference itself loses points, so a mutant's loss of points would prove nothing.
    #[error("the reference itself loses points: run `cargo grade reference`")]
    Reference,
}

/// The selection of the mutants to grade.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MutantSelection {
    /// All mutants.
    All,
    /// A fixed sample of the mutants.
    Sample,
}

impl MutantSelection {
    /// Selects the sample if `fast`, and otherwise all mutants.
    pub fn new(fast: bool) -> Self {
        if fast {
            MutantSelection::Sample
        } else {
            MutantSelection::All
        }
    }

    /// Returns whether the selection includes the mutant with this number.
    fn includes(self, number: usize) -> bool {
        match self {
            MutantSelection::All => true,
            MutantSelection::Sample => number.is_multiple_of(SAMPLE_STEP),
        }
    }

    /// Describes the selection for the report.
    pub fn description(self) -> String {
        match self {
            MutantSelection::All => "selected: all".to_owned(),
            MutantSelection::Sample => {
                format!("selected: one in {SAMPLE_STEP}, in the order of their names")
            }
        }
    }
}

/// Lists all mutants of the reference in the workspace at `root`: runs cargo-mutants if it is
/// installed, and otherwise reads the committed list. In check mode, also reads the committed list
/// if another version of cargo-mutants generated it.
pub fn list(
    handed_out: &'static HandedOut,
    root: &Path,
    mode: Mode,
) -> Result<MutantList, MutantsError> {
    match (cargo_mutants::version(), mode) {
        (None, _) => committed_list(root),
        (Some(version), Mode::Check) if committed_list(root)?.made_by != version => {
            committed_list(root)
        }
        (Some(version), Mode::Check | Mode::Write) => {
            let reference = Sources::reference(root, handed_out)?;
            Ok(cargo_mutants::list(&version, handed_out, root, &reference)?)
        }
    }
}

fn committed_list(root: &Path) -> Result<MutantList, MutantsError> {
    let text = files::read_to_string(root.join(list::PATH))?;
    Ok(serde_json::from_str(&text)?)
}

/// Builds the selected mutants, and grades each with the practice exam.
pub fn run(
    handed_out: &'static HandedOut,
    list: &MutantList,
    selection: MutantSelection,
) -> Result<Findings, MutantsError> {
    let workbench = Workbench::open(handed_out)?;
    let reference = Sources::reference(workbench.root(), handed_out)?;
    let all = list.solutions(handed_out, &reference)?.into_iter();
    let all = all.map(|(mutant, sources)| (mutant.name.clone(), sources));
    let path = equivalent::OF_MUTANTS;
    grade(&workbench, &reference, all.collect(), selection, path)
}

/// Builds the selected systematic mistakes, and grades each with the practice exam.
pub fn run_systematic(
    handed_out: &'static HandedOut,
    selection: MutantSelection,
) -> Result<Findings, MutantsError> {
    let workbench = Workbench::open(handed_out)?;
    let reference = Sources::reference(workbench.root(), handed_out)?;
    let all = systematic_mistakes(handed_out, &reference);
    let path = equivalent::OF_SYSTEMATIC_MISTAKES;
    grade(&workbench, &reference, all, selection, path)
}

/// Builds the selected changes to the reference, and grades each with the practice exam. `path` is
/// the list of those that are equivalent.
fn grade(
    workbench: &Workbench,
    reference: &Sources,
    all: Vec<(String, Sources)>,
    selection: MutantSelection,
    path: &'static str,
) -> Result<Findings, MutantsError> {
    let root = workbench.root();
    let exam = exams::load_practice(root)?;
    if outcome(workbench, reference, "reference", &exam)? != MutantOutcome::Survived {
        return Err(MutantsError::Reference);
    }

    let bar = progress_bar(all.len() as u64, "mutants");
    let outcomes: Result<_, WorkbenchError> = all
        .into_par_iter()
        .enumerate()
        .progress_with(bar)
        .map(|(number, (name, sources))| {
            let outcome = if selection.includes(number) {
                outcome(workbench, &sources, &name, &exam)?
            } else {
                MutantOutcome::Skipped
            };
            Ok((name, outcome))
        })
        .collect();
    Ok(Findings {
        outcomes: outcomes?,
        equivalent: equivalent_mutants(root, path)?,
        path,
    })
}

/// Builds and grades one mutant.
fn outcome(
    workbench: &Workbench,
    sources: &Sources,
    name: &str,
    exam: &Exam,
) -> Result<MutantOutcome, WorkbenchError> {
    let solution = match workbench.build(sources, name) {
        Err(WorkbenchError::NotCompiled { .. }) => return Ok(MutantOutcome::NotCompiled),
        built => built?,
    };
    let score = solution.score(exam)?;
    Ok(if score.points < score.max_points {
        MutantOutcome::Caught
    } else {
        MutantOutcome::Survived
    })
}
