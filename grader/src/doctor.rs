//! `cargo grade --doctor`: what submissions are built with on this machine, and how far they can be
//! kept apart from it.

mod folder;
mod gradescope;
pub mod package;
mod package_contents;

use std::fmt;

use crate::build::{Builder, SelfTestError};
use crate::error::Error;
use crate::sandbox::Isolation;
use crate::select_isolation::{MIN_FOR_UNTRUSTED, with_level};
use crate::workspace::Workspace;

/// What was found, to be printed.
#[derive(Debug)]
pub struct Diagnosis {
    builder: Builder,
    /// From best to worst.
    levels: Vec<(Isolation, Result<(), SelfTestError>)>,
}

/// Looks at everything, and tries every level.
pub fn diagnose() -> Result<Diagnosis, Error> {
    let builder = Builder::prepare(&Workspace::find()?)?;
    let levels = Isolation::ALL.map(|level| (level, with_level(&builder, level).map(drop)));
    Ok(Diagnosis {
        builder,
        levels: levels.into(),
    })
}

impl Diagnosis {
    /// The best level that holds.
    pub fn best_level(&self) -> Isolation {
        let mut holding = self.levels.iter().filter(|(_, held)| held.is_ok());
        holding.next().map_or(Isolation::None, |(level, _)| *level)
    }

    /// 0 where others' work can be graded, else 3.
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
        for (level, held) in &self.levels {
            match held {
                Ok(()) => writeln!(f, "  {:15}holds", level.name())?,
                Err(why) => {
                    writeln!(f, "  {:15}{why}", level.name())?;
                    if let Some(remedy) = remedy(why) {
                        writeln!(f, "  {:15}{remedy}", "")?;
                    }
                }
            }
        }
        match self.exit_code() {
            0 => writeln!(f, "\nOthers' work can be graded here, with --untrusted."),
            _ => writeln!(
                f,
                "\nOnly your own work can be graded here: others' takes {MIN_FOR_UNTRUSTED} or better."
            ),
        }
    }
}

/// What to do, where the reason itself does not say it.
fn remedy(why: &SelfTestError) -> Option<&'static str> {
    match why {
        SelfTestError::NotCompiled(_) => Some(
            "static programs need libc.a: it is in libc6-dev (Debian, Ubuntu), glibc-static \
             (Fedora), musl-dev (Alpine)",
        ),
        SelfTestError::CompilerCanRead
        | SelfTestError::ProgramCan(_)
        | SelfTestError::Incomplete(_) => {
            Some("do not grade others' work here at this level, and tell us: grader/SECURITY.md")
        }
        SelfTestError::Setup(_) => None,
    }
}
