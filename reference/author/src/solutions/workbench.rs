//! Builds and runs solutions. Built programs are cached, because a proof runs each of them many
//! times.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::{Result, anyhow};
use grader::build::{Build, Builder};
use grader::handed_out::HandedOut;
use grader::probe::{Budget, Fault, ItemLimits, Launcher, Probe};
use grader::run_exam::run_exam;
use grader::score::Score;
use grader::verdict::messages::file_message;
use grader::verdict::pending_score;
use grader::workspace::Workspace;
use judging::exam::{Exam, Item};
use judging::exam_file::ExamName;
use protocol::Answer;

use crate::authoring::Authoring;
use crate::solutions::sources::Sources;

/// The time limits for an item, which are for wrong solutions that never terminate. A correct
/// solution takes milliseconds. The known mistake that takes longest needs two seconds until its
/// stack overflows. The limit is far above that, because the exam records how each mistake fails, and
/// a slower machine must not record something else.
const LIMITS: ItemLimits = ItemLimits::from_cpu(Duration::from_secs(10));
/// The CPU time limit for a process, which answers all items of a task.
const PROCESS_CPU: Duration = Duration::from_secs(120);

/// The answers to an item's questions, or the reason there are none.
pub type Answers = Result<Vec<Answer>, Fault>;

/// Builds solutions to an assignment in a workspace.
#[derive(Debug)]
pub struct Workbench {
    authoring: &'static Authoring,
    workspace: Workspace,
    builder: Builder,
}

/// The error to report when a solution doesn't compile.
#[derive(Debug, thiserror::Error)]
#[error("{id} does not compile:\n{message}")]
pub struct NotCompiledError {
    /// The solution's id.
    id: String,
    /// The compiler's message.
    message: String,
}

impl Workbench {
    /// Opens the workspace. Solutions are built as on an instructor's machine: if there is a
    /// reference, its parts replace a solution's wrong parts.
    pub fn open(authoring: &'static Authoring) -> Result<Self> {
        let handed_out = authoring.handed_out;
        let workspace = Workspace::find()?;
        let builder =
            Builder::prepare(&workspace)?.with_cache(&workspace.output_folder().join("kept"))?;
        let builder = match workspace.reference(handed_out) {
            Some(reference) => builder.with_reference(&reference, handed_out, &workspace)?,
            None => builder,
        };
        Ok(Workbench {
            authoring,
            workspace,
            builder,
        })
    }

    /// Returns the assignment.
    pub fn authoring(&self) -> &'static Authoring {
        self.authoring
    }

    /// Returns the assignment as handed out to students.
    pub fn handed_out(&self) -> &'static HandedOut {
        self.authoring.handed_out
    }

    /// Returns the workspace's folder.
    pub fn root(&self) -> &Path {
        self.workspace.root()
    }

    /// Returns the folder for cached results. It can be deleted at any time.
    pub fn scratch(&self) -> PathBuf {
        self.workspace.output_folder()
    }

    /// Builds a solution. Returns an error if any of its files doesn't compile.
    pub fn build(&self, sources: &Sources, id: &str) -> Result<BuiltSolution> {
        let builder = match sources.crates() {
            [] => Cow::Borrowed(&self.builder),
            names => Cow::Owned(self.builder.with_crates(names, &self.workspace)?),
        };
        let build = builder.build(&sources.to_submission(id))?;
        let error = |message| NotCompiledError {
            id: id.to_owned(),
            message,
        };
        if let Some((file, reason)) = build.not_compiled.first_key_value() {
            return Err(error(file_message(file, reason)).into());
        }
        let program = build.probe.clone();
        let program = program.ok_or_else(|| error("the build produced no program".to_owned()))?;
        Ok(BuiltSolution {
            id: id.to_owned(),
            handed_out: self.handed_out(),
            launcher: build.launcher(&program),
            build,
        })
    }
}

/// A solution that is built and ready to run.
#[derive(Debug)]
pub struct BuiltSolution {
    /// The solution's id.
    pub id: String,
    handed_out: &'static HandedOut,
    build: Build,
    launcher: Launcher,
}

impl BuiltSolution {
    /// Returns the launcher of the solution's probe.
    pub fn launcher(&self) -> &Launcher {
        &self.launcher
    }

    /// Runs the solution in a new probe. Returns its answers to one item.
    pub fn answers(&self, item: &Item) -> Result<Answers> {
        Ok(self.answers_to_each(&[item])?.remove(0))
    }

    /// Runs the solution. Returns its answers to each item. As in grading, one process answers all
    /// items of a task, and a new process is started only after a fault. Otherwise, mistakes that
    /// keep state between calls wouldn't show up, since they only affect later items.
    pub fn answers_to_each(&self, items: &[&Item]) -> Result<Vec<Answers>> {
        let mut running = None;
        let mut all = Vec::new();
        for item in items {
            let mut probe: Probe = match running.take() {
                Some(probe) => probe,
                None => {
                    let started = self.launcher.start(PROCESS_CPU);
                    started.map_err(|error| anyhow!("cannot start a probe: {error}"))?
                }
            };
            let questions = item.questions.iter().map(|question| &question.question);
            let answers = probe.ask(questions, LIMITS);
            running = answers.is_ok().then_some(probe);
            all.push(answers);
        }
        Ok(all)
    }

    /// Grades the solution with an exam.
    pub fn score(&self, exam: &Exam) -> Result<Score> {
        let name = ExamName {
            id: exam.id.clone(),
            hash: String::new(),
        };
        let mut score = pending_score(exam, name, &self.id, self.handed_out);
        run_exam(
            exam,
            &self.build,
            Budget::default(),
            1,
            &mut score,
            |_, _| Ok::<(), anyhow::Error>(()),
        )?;
        Ok(score)
    }
}
