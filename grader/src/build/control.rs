//! An honest program, which is compiled and run when the system has killed a submission's program
//! or its compiler, although nothing else was running. If the honest program gets to its end, the
//! machine is not the reason.

use std::io;
use std::path::PathBuf;

use tempfile::TempDir;

use crate::build::rustc::{CompileAttempt, CompileOutcome, CrateKind, Rustc};
use crate::build::trial;

const SOURCE: &str = include_str!("../../trial/control.rs");
const NAME: &str = "control";
/// The program's output.
const OUTPUT: &str = "end\n";

/// Compiles and runs the honest program.
#[derive(Clone, Debug)]
pub struct Control {
    pub(super) rustc: Rustc,
    /// A folder for the program.
    pub(super) folder: PathBuf,
}

impl Control {
    /// Returns whether the honest program can be compiled.
    pub(super) fn compiles(&self) -> io::Result<bool> {
        Ok(self.compile()?.is_some())
    }

    /// Returns whether the honest program gets to its end. It uses as much memory as a program may
    /// use without being considered out of memory.
    pub fn runs(&self) -> io::Result<bool> {
        let Some((_folder, program)) = self.compile()? else {
            return Ok(false);
        };
        Ok(trial::run(&self.rustc.sandbox, &program, "")? == OUTPUT)
    }

    /// Returns the program, and the folder that keeps it, or `None` if the system kills the
    /// compiler.
    fn compile(&self) -> io::Result<Option<(TempDir, PathBuf)>> {
        let folder = TempDir::new_in(&self.folder)?;
        let kind = CrateKind::Program;
        let compiled = trial::compile(&self.rustc, folder.path(), NAME, SOURCE, kind)?;
        match compiled {
            CompileAttempt::Ended(CompileOutcome::Done(program)) => Ok(Some((folder, program))),
            CompileAttempt::Ended(CompileOutcome::Errors(errors)) => {
                Err(io::Error::other(errors[0].text().to_owned()))
            }
            CompileAttempt::Ended(CompileOutcome::Failed(why)) => Err(io::Error::other(why)),
            CompileAttempt::Killed => Ok(None),
        }
    }
}
