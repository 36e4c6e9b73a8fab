//! What becomes of a submission: programs that can be asked.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use crate::build::blame::NotCompiled;
use crate::build::build_dir::BuildDir;
use crate::build::substitution::Substitution;
use crate::probe::Launcher;
use crate::sandbox::{Isolation, Sandbox};

/// A submission, ready to be asked.
#[derive(Debug)]
pub struct Build {
    /// The program, unless nothing could be compiled.
    pub probe: Option<PathBuf>,
    /// The files whose tasks can not be graded, and why.
    pub not_compiled: BTreeMap<&'static str, NotCompiled>,
    pub(super) substitution: Option<Substitution>,
    pub(super) sandbox: Sandbox,
    /// Holds the programs; vanishes with them.
    pub(super) _build_dir: BuildDir,
}

/// A submission's `bvh.rs` with the reference's parts in place of its other files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SubstitutedProgram<'a> {
    /// The program.
    Program(&'a Path),
    /// It does not compile there.
    NotCompiled,
    /// There is no reference here, or no `bvh.rs`.
    NoReference,
}

impl Build {
    /// How submissions are kept apart from the machine.
    pub fn isolation(&self) -> Isolation {
        self.sandbox.level()
    }

    /// What starts one of its programs.
    pub fn launcher(&self, program: &Path) -> Launcher {
        Launcher {
            program: program.to_owned(),
            sandbox: self.sandbox.clone(),
        }
    }

    /// The program with the reference's parts, compiled when it is first asked for.
    pub fn substituted_program(&self) -> io::Result<SubstitutedProgram<'_>> {
        let Some(carry) = &self.substitution else {
            return Ok(SubstitutedProgram::NoReference);
        };
        Ok(match carry.program()? {
            Some(program) => SubstitutedProgram::Program(program),
            None => SubstitutedProgram::NotCompiled,
        })
    }
}
