//! `cargo grade --doctor`: reports the compiler that submissions are built with and the isolation
//! levels available on this machine.

mod folder;
mod gradescope;
pub mod package;

use std::fmt;

use crate::build::select_isolation::{MIN_FOR_UNTRUSTED, with_level};
use crate::build::{Builder, SelfTestError};
use crate::error::Error;
use crate::sandbox::Isolation;
use crate::workspace::Workspace;

/// The findings of `--doctor`, to be printed.
#[derive(Debug)]
pub struct Diagnosis {
    builder: Builder,
    /// The isolation levels, from best to worst, each with the result of testing it.
    levels: Vec<(Isolation, Result<(), SelfTestError>)>,
}

/// Finds the compiler, prepares the submissions' dependencies and tests every isolation level.
pub fn diagnose() -> Result<Diagnosis, Error> {
    let builder = Builder::prepare(&Workspace::find()?)?;
    let levels = Isolation::ALL.map(|level| (level, with_level(&builder, level).map(drop)));
    Ok(Diagnosis {
        builder,
        levels: levels.into(),
    })
}

impl Diagnosis {
    /// Returns the best available isolation level.
    pub fn best_level(&self) -> Isolation {
        let mut working = self.levels.iter().filter(|(_, result)| result.is_ok());
        working.next().map_or(Isolation::None, |(level, _)| *level)
    }

    /// Returns the exit code: 0 if other people's work can be graded on this machine, otherwise 3.
    pub fn exit_code(&self) -> u8 {
        if self.best_level() >= MIN_FOR_UNTRUSTED {
            0
        } else {
            3
        }
    }
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "compiler       {}", self.builder.compiler().display())?;
        writeln!(
            f,
            "dependencies   {}",
            self.builder.dependencies().display()
        )?;
        writeln!(f, "isolation      {}\n", self.best_level())?;
        for (level, result) in &self.levels {
            match result {
                Ok(()) => writeln!(f, "  {:15}works", level.name())?,
                Err(why) => {
                    writeln!(f, "  {:15}{why}", level.name())?;
                    if let Some(remedy) = remedy(why) {
                        writeln!(f, "  {:15}{remedy}", "")?;
                    }
                }
            }
        }
        match self.exit_code() {
            0 => writeln!(
                f,
                "\nYou can grade other people's work on this machine, with --untrusted."
            ),
            _ => writeln!(
                f,
                "\nYou can only grade your own work on this machine: grading other people's work requires \
                 isolation level {MIN_FOR_UNTRUSTED} or better."
            ),
        }
    }
}

/// Returns advice for a level that isn't available, unless the reason already says what to do.
fn remedy(why: &SelfTestError) -> Option<&'static str> {
    match why {
        SelfTestError::NotCompiled(_) => Some(
            "static programs need libc.a: install libc6-dev (Debian, Ubuntu), glibc-static \
             (Fedora) or musl-dev (Alpine)",
        ),
        SelfTestError::Unsafe(_) => Some(
            "do not grade other people's work at this level; report the problem as described in \
            grader/SECURITY.md",
        ),
        SelfTestError::Setup(_) => None,
    }
}
