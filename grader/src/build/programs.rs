//! The result of building a submission: its programs.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use crate::build::blame::NotCompiled;
use crate::build::build_dir::BuildDir;
use crate::build::control::Control;
use crate::build::substitution::Substitution;
use crate::handed_out::HandedOut;
use crate::probe::{Interrupt, Launcher};
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
    /// Ends the programs' answers early.
    pub interrupt: Interrupt,
    pub(super) substitutions: Vec<Substitution>,
    pub(super) control: Control,
    /// The directory that contains the programs. It is removed when this value is dropped.
    pub(super) _build_dir: BuildDir,
}

/// A submission's file compiled with the reference's parts in place of its other files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SubstitutedProgram<'a> {
    /// The program, by its path.
    Program(&'a Path),
    /// The submission's file does not compile with these parts.
    NotCompiled,
    /// There is no reference, there are no parts for this file, or the submission's file is missing
    /// or does not compile.
    NoReference,
}

impl Build {
    /// Returns the isolation level at which the submission was compiled and will run.
    pub fn isolation(&self) -> Isolation {
        self.control.rustc.sandbox.level()
    }

    /// Returns the honest program that shows whether the machine is the reason for a failure.
    pub fn control(&self) -> &Control {
        &self.control
    }

    /// Returns a launcher for one of the programs.
    pub fn launcher(&self, program: &Path) -> Launcher {
        Launcher {
            program: program.to_owned(),
            sandbox: self.control.rustc.sandbox.clone(),
            interrupt: self.interrupt.clone(),
        }
    }

    /// Returns the program in which the reference's parts replace all files but this one. It is
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

#[cfg(test)]
impl Build {
    /// Returns a build without programs, in this folder. These files did not compile.
    pub fn without_programs(
        folder: &Path,
        not_compiled: BTreeMap<&'static str, NotCompiled>,
    ) -> Self {
        use crate::build::dependencies::Dependencies;
        use crate::build::linker::SystemLinker;
        use crate::build::rustc::Rustc;
        use crate::build::toolchain::Toolchain;
        use crate::sandbox::Sandbox;

        let rustc = Rustc {
            toolchain: Toolchain {
                cargo: PathBuf::new(),
                rustc: PathBuf::new(),
                linker: SystemLinker::find(),
            },
            dependencies: Dependencies {
                externs: BTreeMap::new(),
                folder: PathBuf::new(),
            },
            cache: None,
            sandbox: Sandbox::none(),
        };
        Build {
            handed_out: &crate::handed_out::RAYS,
            probe: None,
            not_compiled,
            interrupt: Interrupt::default(),
            substitutions: Vec::new(),
            control: Control {
                rustc,
                folder: folder.to_owned(),
            },
            _build_dir: BuildDir::new_in(folder).unwrap(),
        }
    }
}
