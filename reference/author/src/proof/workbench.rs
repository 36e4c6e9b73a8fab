//! Building and asking many solutions, again and again: what was built once is kept.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

use grader::ask::{Budget, Fault, Launcher};
use grader::build::{Build, BuildError, Builder, NotCompiled};
use grader::exam::{Exam, Item};
use grader::exam_file::ExamName;
use grader::examine::examine;
use grader::score::Score;
use grader::verdict::{file_message, unasked};
use grader::workspace::{NoWorkspace, Workspace};

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
pub enum NotTried {
    /// There is no project around.
    #[error(transparent)]
    Workspace(#[from] NoWorkspace),
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
    pub fn open() -> Result<Self, NotTried> {
        let workspace = Workspace::find()?;
        let builder = Builder::prepare(&workspace)?.keeping(&workspace.grade().join("kept"))?;
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
        self.workspace.grade()
    }

    /// Builds a solution, of which all must compile.
    pub fn build(&self, sources: &Sources, id: &str) -> Result<Solution, NotTried> {
        let builder = match sources.crates() {
            [] => Cow::Borrowed(&self.builder),
            names => Cow::Owned(self.builder.and_crates(names, &self.workspace)?),
        };
        let build = builder.build(&sources.submission(id))?;
        if let Some(message) = complaint(&build.not_compiled) {
            let id = id.to_owned();
            return Err(NotTried::NotCompiled { id, message });
        }
        let id = id.to_owned();
        match build.probe.clone() {
            Some(program) => Ok(Solution {
                id,
                launcher: build.launcher(&program),
                build,
            }),
            None => Err(NotTried::NotCompiled {
                id,
                message: "there is no program".to_owned(),
            }),
        }
    }
}

fn complaint(not_compiled: &BTreeMap<&'static str, NotCompiled>) -> Option<String> {
    let (file, why) = not_compiled.first_key_value()?;
    Some(file_message(file, why))
}

/// A solution, ready to be asked.
#[derive(Debug)]
pub struct Solution {
    /// Whose.
    pub id: String,
    build: Build,
    launcher: Launcher,
}

impl Solution {
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
    pub fn score(&self, exam: &Exam) -> Result<Score, NotTried> {
        let name = ExamName {
            id: exam.id.clone(),
            hash: String::new(),
        };
        let mut score = unasked(exam, name, &self.id);
        examine(exam, &self.build, BUDGET, &mut score, |_, _| {
            Ok::<(), NotTried>(())
        })?;
        Ok(score)
    }
}
