//! That the exam catches what nobody thought of: every small change that cargo-mutants makes of the
//! reference's five files loses points, but for those that no answer can tell from it.
//!
//! Beside the catalogue of mistakes, which people made, this is the other half: mistakes that a
//! program made, without knowing what the exam asks.

pub mod cargo_mutants;
pub mod equivalent;
pub mod findings;
pub mod list;
pub mod span;

use std::path::Path;

use grader::exam::Exam;
use grader::exam_file::ExamError;
use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use rayon::prelude::*;

use crate::exams;
use crate::generated_file::Mode;
use crate::proof::mutants::cargo_mutants::CargoMutantsError;
use crate::proof::mutants::equivalent::{EquivalentsError, equivalent_mutants};
use crate::proof::mutants::findings::{Findings, MutantOutcome};
use crate::proof::mutants::list::{MutantList, OutdatedListError};
use crate::proof::sources::{ReadError, Sources, read};
use crate::proof::workbench::{Workbench, WorkbenchError};

/// In haste, one in so many is asked, in the order of their names.
const SAMPLE_STEP: usize = 8;

/// The mutants were not asked: our fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum MutantsError {
    /// A file can not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Cargo-mutants makes no list.
    #[error(transparent)]
    CargoMutants(#[from] CargoMutantsError),
    /// The list that is committed is not one.
    #[error(
        "{path}: {0}; run `cargo author mutants` where cargo-mutants is installed",
        path = list::PATH
    )]
    CommittedList(#[from] serde_json::Error),
    /// The list is of another reference.
    #[error(transparent)]
    OutdatedList(#[from] OutdatedListError),
    /// The list of those that survive can not be used.
    #[error(transparent)]
    Equivalents(#[from] EquivalentsError),
    /// The practice exam can not be used.
    #[error(transparent)]
    Exam(#[from] ExamError),
    /// A mutant can not be built or asked.
    #[error(transparent)]
    Workbench(#[from] WorkbenchError),
    /// Then a mutant that loses points says nothing.
    #[error("the reference itself loses points: see `cargo grade reference`")]
    Reference,
}

/// Which of the mutants are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MutantSelection {
    /// All.
    All,
    /// A part that is the same every time.
    Sample,
}

impl MutantSelection {
    /// A part if `fast`.
    pub fn new(fast: bool) -> Self {
        if fast {
            MutantSelection::Sample
        } else {
            MutantSelection::All
        }
    }

    /// Whether it takes in the mutant of this number.
    fn includes(self, number: usize) -> bool {
        match self {
            MutantSelection::All => true,
            MutantSelection::Sample => number.is_multiple_of(SAMPLE_STEP),
        }
    }

    /// What was asked, for the closing lines.
    pub fn description(self) -> String {
        match self {
            MutantSelection::All => "asked: all".to_owned(),
            MutantSelection::Sample => {
                format!("asked: one in {SAMPLE_STEP}, in the order of their names")
            }
        }
    }
}

/// All mutants of the reference of the workspace at `root`: from cargo-mutants where it is
/// installed, else as they are committed. To check what is committed takes the version that made it.
pub fn list(root: &Path, mode: Mode) -> Result<MutantList, MutantsError> {
    match (cargo_mutants::version(), mode) {
        (None, _) => committed_list(root),
        (Some(version), Mode::Check) if committed_list(root)?.made_by != version => {
            committed_list(root)
        }
        (Some(version), Mode::Check | Mode::Write) => {
            let reference = Sources::reference(root)?;
            Ok(cargo_mutants::list(&version, root, &reference)?)
        }
    }
}

fn committed_list(root: &Path) -> Result<MutantList, MutantsError> {
    Ok(serde_json::from_str(&read(&root.join(list::PATH))?)?)
}

/// Builds the mutants and asks each the practice exam.
pub fn run(list: &MutantList, extent: MutantSelection) -> Result<Findings, MutantsError> {
    let workbench = Workbench::open()?;
    let root = workbench.root();
    let exam = exams::load_practice(root)?;
    let reference = Sources::reference(root)?;
    if outcome(&workbench, &reference, "reference", &exam)? != MutantOutcome::Survived {
        return Err(MutantsError::Reference);
    }

    let all = list.solutions(&reference)?;
    let bar = ProgressBar::new(all.len() as u64).with_style(
        ProgressStyle::with_template("{wide_bar} {pos} of {len} mutants, {eta} left")
            .expect("a template that was tried"),
    );
    let fates: Result<_, WorkbenchError> = all
        .into_par_iter()
        .enumerate()
        .progress_with(bar)
        .map(|(number, (mutant, sources))| {
            let name = &mutant.name;
            let fate = match extent.includes(number) {
                true => outcome(&workbench, &sources, name, &exam)?,
                false => MutantOutcome::Skipped,
            };
            Ok((name.clone(), fate))
        })
        .collect();
    Ok(Findings {
        outcomes: fates?,
        equivalent: equivalent_mutants(root)?,
    })
}

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
