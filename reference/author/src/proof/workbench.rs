//! Building and asking many solutions, again and again: what was built once is kept.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use grader::build::{Build, BuildError, Builder, NotCompiled};
use grader::exam::{Exam, Item};
use grader::exam_file::ExamName;
use grader::probe::{Budget, Fault, Launcher};
use grader::run_exam::run_exam;
use grader::score::Score;
use grader::verdict::{file_message, pending_score};
use grader::workspace::{Workspace, WorkspaceError};

use protocol::Answer;

use crate::proof::sources::Sources;

/// An honest item takes milliseconds; a mistake that never ends should not take long.
const BUDGET: Budget = Budget {
    cpu: Duration::from_secs(2),
};

/// What builds solutions.
#[derive(Debug)]
pub struct Workbench {
    workspace: Workspace,
    builder: Builder,
}

/// A solution of ours was not tried: our fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum WorkbenchError {
    /// There is no project around.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
    /// The grader can not build.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The solution does not compile.
    #[error("{id} does not compile:\n{message}")]
    NotCompiled {
        /// Which.
        id: String,
        /// The compiler's words.
        message: String,
    },
    /// A probe can not be started.
    #[error("can not start a probe: {0}")]
    Probe(#[from] std::io::Error),
}

impl Workbench {
    /// As the staff's grader builds: with the reference at hand.
    pub fn open() -> Result<Self, WorkbenchError> {
        let workspace = Workspace::find()?;
        let builder =
            Builder::prepare(&workspace)?.with_cache(&workspace.output_folder().join("kept"))?;
        let builder = match workspace.reference() {
            Some(reference) => builder.with_reference(&reference, &workspace)?,
            None => builder,
        };
        Ok(Workbench { workspace, builder })
    }

    /// The workspace's folder.
    pub fn root(&self) -> &Path {
        self.workspace.root()
    }

    /// Where results may be kept that can be made again.
    pub fn scratch(&self) -> PathBuf {
        self.workspace.output_folder()
    }

    /// Builds a solution, of which all must compile.
    pub fn build(&self, sources: &Sources, id: &str) -> Result<BuiltSolution, WorkbenchError> {
        let builder = match sources.crates() {
            [] => Cow::Borrowed(&self.builder),
            names => Cow::Owned(self.builder.with_crates(names, &self.workspace)?),
        };
        let build = builder.build(&sources.to_submission(id))?;
        if let Some(message) = compile_error(&build.not_compiled) {
            let id = id.to_owned();
            return Err(WorkbenchError::NotCompiled { id, message });
        }
        let id = id.to_owned();
        match build.probe.clone() {
            Some(program) => Ok(BuiltSolution {
                id,
                launcher: build.launcher(&program),
                build,
            }),
            None => Err(WorkbenchError::NotCompiled {
                id,
                message: "there is no program".to_owned(),
            }),
        }
    }
}

fn compile_error(not_compiled: &BTreeMap<&'static str, NotCompiled>) -> Option<String> {
    let (file, why) = not_compiled.first_key_value()?;
    Some(file_message(file, why))
}

/// A solution, ready to be asked.
#[derive(Debug)]
pub struct BuiltSolution {
    /// Whose.
    pub id: String,
    build: Build,
    launcher: Launcher,
}

impl BuiltSolution {
    /// Starts its probe.
    pub fn launcher(&self) -> &Launcher {
        &self.launcher
    }

    /// Its answers to one item, each item of a fresh probe.
    pub fn answers(&self, item: &Item) -> std::io::Result<Result<Vec<Answer>, Fault>> {
        let mut probe = self.launcher.start(BUDGET)?;
        let questions = item.questions.iter().map(|asked| &asked.question);
        Ok(probe.ask(questions, BUDGET))
    }

    /// Its score in an exam.
    pub fn score(&self, exam: &Exam) -> Result<Score, WorkbenchError> {
        let name = ExamName {
            id: exam.id.clone(),
            hash: String::new(),
        };
        let mut score = pending_score(exam, name, &self.id);
        run_exam(exam, &self.build, BUDGET, &mut score, |_, _| {
            Ok::<(), WorkbenchError>(())
        })?;
        Ok(score)
    }
}
