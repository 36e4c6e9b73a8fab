//! `cargo grade --doctor`: what submissions are built with on this machine, and how far they can be
//! kept apart from it.

mod contents;
mod folder;
mod gradescope;
pub mod package;

use std::fmt;

use crate::build::{Builder, Shortfall};
use crate::error::Error;
use crate::isolate::{LEAST, tried};
use crate::sandbox::Isolation;
use crate::workspace::Workspace;

/// What was found, to be printed.
#[derive(Debug)]
pub struct Diagnosis {
    builder: Builder,
    /// From best to worst.
    levels: Vec<(Isolation, Result<(), Shortfall>)>,
}

/// Looks at everything, and tries every level.
pub fn examine_machine() -> Result<Diagnosis, Error> {
    let builder = Builder::prepare(&Workspace::find()?)?;
    let levels = Isolation::ALL.map(|level| (level, tried(&builder, level).map(drop)));
    Ok(Diagnosis {
        builder,
        levels: levels.into(),
    })
}

impl Diagnosis {
    /// The best level that holds.
    pub fn isolation(&self) -> Isolation {
        let mut holding = self.levels.iter().filter(|(_, held)| held.is_ok());
        holding.next().map_or(Isolation::None, |(level, _)| *level)
    }

    /// 0 where others' work can be graded, else 3.
    pub fn exit_code(&self) -> u8 {
        if self.isolation() >= LEAST { 0 } else { 3 }
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
        writeln!(f, "isolation      {}\n", self.isolation())?;
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
                "\nOnly your own work can be graded here: others' takes {LEAST} or better."
            ),
        }
    }
}

/// What to do, where the reason itself does not say it.
fn remedy(why: &Shortfall) -> Option<&'static str> {
    match why {
        Shortfall::NotCompiled(_) => Some(
            "static programs need libc.a: it is in libc6-dev (Debian, Ubuntu), glibc-static \
             (Fedora), musl-dev (Alpine)",
        ),
        Shortfall::CompilerReads | Shortfall::ProgramCan(_) | Shortfall::NotTried(_) => {
            Some("do not grade others' work here at this level, and tell us: grader/SECURITY.md")
        }
        Shortfall::NotInPlace(_) => None,
    }
}
