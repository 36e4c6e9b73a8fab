//! The result of building a submission: its programs.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use judging::assignment::Task;

use crate::build::blame::NotCompiled;
use crate::build::build_dir::BuildDir;
use crate::build::compile::compile_starter;
use crate::build::diagnostics::Diagnostic;
use crate::build::rustc::Rustc;
use crate::build::substitution::Substitution;
use crate::build::trial;
use crate::handed_out::{HandedOut, TaskMethods};
use crate::probe::{Interrupt, Launcher, START_LIMITS};
use crate::sandbox::Isolation;

/// A built submission.
#[derive(Debug)]
pub struct Build {
    /// The assignment.
    pub handed_out: &'static HandedOut,
    /// Path of the program, or `None` if nothing compiled.
    pub probe: Option<PathBuf>,
    /// Files whose tasks cannot be graded, with the reasons.
    pub not_compiled: BTreeMap<&'static str, NotCompiled>,
    /// The submission's method for each task. Methods that aren't found are left out.
    pub methods: BTreeMap<Task, TaskMethods>,
    /// The compiler's warnings.
    pub warnings: Vec<Diagnostic>,
    /// How long the build took.
    pub took: Duration,
    /// Stops the programs early.
    pub interrupt: Interrupt,
    pub(super) substitutions: Vec<Substitution>,
    /// The programs that cannot be started even though the starter's program can.
    pub(super) unstartable: Mutex<BTreeSet<PathBuf>>,
    /// The compiler, used for control programs that show whether the machine is the reason for a
    /// failure.
    pub(super) rustc: Rustc,
    /// The directory that contains the programs. It is removed when this value is dropped.
    pub(super) build_dir: BuildDir,
}

/// A program made of several submissions.
#[derive(Debug)]
pub struct LinkedProgram {
    /// Starts the program.
    pub launcher: Launcher,
    /// The directory that contains the program. It is removed when this value is dropped.
    pub(super) _build_dir: BuildDir,
}

/// The result of compiling a submission's file with the reference's parts in place of the
/// submission's other files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SubstitutedProgram<'a> {
    /// The path of the program.
    Program(&'a Path),
    /// The submission's file doesn't compile when it is combined with these parts.
    NotCompiled,
    /// There is no reference, there are no parts for this file, or the submission's file is missing
    /// or doesn't compile.
    NoReference,
}

impl Build {
    /// Returns the isolation level that the submission was compiled with and will run with.
    pub fn isolation(&self) -> Isolation {
        self.rustc.sandbox.level()
    }

    /// Returns whether building again would give the same result.
    pub fn is_reproducible(&self) -> bool {
        let mut why = self.not_compiled.values();
        why.all(NotCompiled::is_reproducible)
    }

    /// Returns an error unless the control program can be compiled and run. If it can, the machine
    /// isn't the reason another program was killed.
    pub fn check_run(&self) -> io::Result<()> {
        trial::check_run(&self.rustc, &self.build_dir.path().join("control"))
    }

    /// Returns a launcher for one of the programs.
    pub fn launcher(&self, program: &Path) -> Launcher {
        Launcher {
            program: program.to_owned(),
            sandbox: self.rustc.sandbox.clone(),
            interrupt: self.interrupt.clone(),
        }
    }

    /// Returns an error unless the starter, compiled in the same way as this program, can be
    /// started. If it can, the machine isn't the reason this program cannot be started. `cpu` is
    /// the starter's CPU time limit.
    pub fn check_start(&self, program: &Path, cpu: Duration) -> io::Result<()> {
        let mut substitutions = self.substitutions.iter();
        let is_of = |substitution: &&Substitution| {
            let made = substitution.program.get().and_then(Option::as_deref);
            made == Some(program)
        };
        let starter = match substitutions.find(is_of) {
            Some(substitution) => substitution.starter_program()?,
            None => {
                let folder = self.build_dir.path().join("starter");
                compile_starter(self.handed_out, &folder, &self.rustc).map_err(io::Error::other)?
            }
        };
        let started = self.launcher(&starter).start(cpu)?.ask([], START_LIMITS);
        started.map_err(|fault| {
            io::Error::other(format!(
                "even the unmodified starter code fails to run: {fault}; see `cargo grade --doctor`"
            ))
        })?;
        self.unstartable().insert(program.to_owned());
        Ok(())
    }

    /// Returns whether [`Build::check_start`] has shown that this program cannot be started.
    pub fn is_unstartable(&self, program: &Path) -> bool {
        self.unstartable().contains(program)
    }

    fn unstartable(&self) -> MutexGuard<'_, BTreeSet<PathBuf>> {
        let known = self.unstartable.lock();
        known.unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the program in which the reference's parts replace all files except this one. It is
    /// compiled on the first call.
    pub fn substituted_program(&self, file: &str) -> io::Result<SubstitutedProgram<'_>> {
        let mut substitutions = self.substitutions.iter();
        let Some(substitution) = substitutions.find(|known| known.file.name == file) else {
            return Ok(SubstitutedProgram::NoReference);
        };
        Ok(match substitution.program()? {
            Some(program) => SubstitutedProgram::Program(program),
            None => SubstitutedProgram::NotCompiled,
        })
    }
}
