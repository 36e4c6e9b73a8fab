//! An honest program, which is compiled and run when the system has killed a submission's program
//! or its compiler, although nothing else was running. If the honest program gets to its end, the
//! machine is not the reason.

use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::build::rustc::{CompileOutcome, CrateKind, Rustc};
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
    /// Returns a control that compiles beside the folder of another crate.
    pub(super) fn beside(rustc: &Rustc, folder: &Path) -> Self {
        Control {
            rustc: rustc.clone(),
            folder: folder.parent().unwrap_or(folder).to_owned(),
        }
    }

    /// Returns an error unless the honest program can be compiled.
    pub(super) fn check_compiler(&self) -> io::Result<()> {
        self.compile().map(drop)
    }

    /// Returns an error unless the honest program gets to its end. It uses as much memory as a
    /// program may use without being considered out of memory.
    pub fn check_run(&self) -> io::Result<()> {
        let (_folder, program) = self.compile()?;
        if trial::run(&self.rustc.sandbox, &program, "")? == OUTPUT {
            return Ok(());
        }
        Err(io::Error::other(
            "the system killed the program (signal 9) although it used little memory, and a small \
             program of the grader, too: give this machine more memory, or grade fewer submissions \
             at once",
        ))
    }

    /// Returns the program, and the folder that keeps it.
    fn compile(&self) -> io::Result<(TempDir, PathBuf)> {
        let folder = TempDir::new_in(&self.folder)?;
        let kind = CrateKind::Program;
        match trial::compile(&self.rustc, folder.path(), NAME, SOURCE, kind)? {
            CompileOutcome::Done(program) => Ok((folder, program)),
            CompileOutcome::Errors(errors) => Err(io::Error::other(errors[0].text().to_owned())),
            CompileOutcome::Failed(why) => Err(io::Error::other(why)),
        }
    }
}
