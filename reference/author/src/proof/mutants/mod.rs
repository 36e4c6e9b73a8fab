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
use grader::exam_file::BadExam;
use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use rayon::prelude::*;

use crate::exams;
use crate::generated::Mode;
use crate::proof::mutants::cargo_mutants::NoList;
use crate::proof::mutants::equivalent::{BadEquivalents, equivalents};
use crate::proof::mutants::findings::{Fate, Findings};
use crate::proof::mutants::list::{DoesNotFit, List};
use crate::proof::sources::{Sources, Unreadable, read};
use crate::proof::workbench::{NotTried, Workbench};

/// In haste, one in so many is asked, in the order of their names.
const FAST: usize = 8;

/// The mutants were not asked: our fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum NotAsked {
    /// A file can not be read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// Cargo-mutants makes no list.
    #[error(transparent)]
    NoList(#[from] NoList),
    /// The list that is committed is not one.
    #[error(
        "{path}: {0}; run `cargo author mutants` where cargo-mutants is installed",
        path = list::PATH
    )]
    BadList(#[from] serde_json::Error),
    /// The list is of another reference.
    #[error(transparent)]
    DoesNotFit(#[from] DoesNotFit),
    /// The list of those that survive can not be used.
    #[error(transparent)]
    Equivalents(#[from] BadEquivalents),
    /// The practice exam can not be used.
    #[error(transparent)]
    Exam(#[from] BadExam),
    /// A mutant can not be built or asked.
    #[error(transparent)]
    NotTried(#[from] NotTried),
    /// Then a mutant that loses points says nothing.
    #[error("the reference itself loses points: see `cargo grade reference`")]
    Reference,
}

/// Which of the mutants are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// All.
    Whole,
    /// A part that is the same every time.
    Fast,
}

impl Extent {
    /// A part if `fast`.
    pub fn new(fast: bool) -> Self {
        if fast { Extent::Fast } else { Extent::Whole }
    }

    /// Whether it takes in the mutant of this number.
    fn holds(self, number: usize) -> bool {
        match self {
            Extent::Whole => true,
            Extent::Fast => number.is_multiple_of(FAST),
        }
    }

    /// What was asked, for the closing lines.
    pub fn words(self) -> String {
        match self {
            Extent::Whole => "asked: all".to_owned(),
            Extent::Fast => format!("asked: one in {FAST}, in the order of their names"),
        }
    }
}

/// All mutants of the reference of the workspace at `root`: from cargo-mutants where it is
/// installed, else as they are committed. To check what is committed takes the version that made it.
pub fn list(root: &Path, mode: Mode) -> Result<List, NotAsked> {
    match (cargo_mutants::version(), mode) {
        (None, _) => committed(root),
        (Some(version), Mode::Check) if committed(root)?.made_by != version => committed(root),
        (Some(version), Mode::Check | Mode::Write) => {
            let reference = Sources::reference(root)?;
            Ok(cargo_mutants::list(&version, root, &reference)?)
        }
    }
}

fn committed(root: &Path) -> Result<List, NotAsked> {
    Ok(serde_json::from_str(&read(&root.join(list::PATH))?)?)
}

/// Builds the mutants and asks each the practice exam.
pub fn ask(list: &List, extent: Extent) -> Result<Findings, NotAsked> {
    let workbench = Workbench::open()?;
    let root = workbench.root();
    let exam = exams::practice(root)?;
    let reference = Sources::reference(root)?;
    if fate(&workbench, &reference, "reference", &exam)? != Fate::Survives {
        return Err(NotAsked::Reference);
    }

    let all = list.solutions(&reference)?;
    let bar = ProgressBar::new(all.len() as u64).with_style(
        ProgressStyle::with_template("{wide_bar} {pos} of {len} mutants, {eta} left")
            .expect("a template that was tried"),
    );
    let fates: Result<_, NotTried> = all
        .into_par_iter()
        .enumerate()
        .progress_with(bar)
        .map(|(number, (mutant, sources))| {
            let name = &mutant.name;
            let fate = match extent.holds(number) {
                true => fate(&workbench, &sources, name, &exam)?,
                false => Fate::NotAsked,
            };
            Ok((name.clone(), fate))
        })
        .collect();
    Ok(Findings {
        fates: fates?,
        equivalent: equivalents(root)?,
    })
}

fn fate(
    workbench: &Workbench,
    sources: &Sources,
    name: &str,
    exam: &Exam,
) -> Result<Fate, NotTried> {
    let solution = match workbench.build(sources, name) {
        Err(NotTried::NotCompiled { .. }) => return Ok(Fate::NotCompiled),
        built => built?,
    };
    let score = solution.score(exam)?;
    Ok(if score.points < score.max_points {
        Fate::Caught
    } else {
        Fate::Survives
    })
}
