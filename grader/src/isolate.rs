//! Which isolation a submission is graded with: what was asked for, or no grading at all.

use std::fmt::Write;

use crate::build::{Builder, Shortfall};
use crate::cli::Arguments;
use crate::sandbox::{Isolation, Sandbox};

/// The least for code that is not one's own, unless another level is named.
pub const LEAST: Isolation = Isolation::NoNamespaces;

/// What was asked for is not to be had here.
#[derive(Debug, thiserror::Error)]
pub enum NotIsolated {
    /// The level that was named.
    #[error("isolation {level} is not reached: {why}\n{NEXT}")]
    Named {
        /// Which.
        level: Isolation,
        /// Why.
        why: Shortfall,
    },
    /// None of those that are good enough.
    #[error("others' code is not graded here: isolation is worse than {LEAST}\n{missing}{NEXT}")]
    NoneGoodEnough {
        /// A line for each that was tried.
        missing: String,
    },
}

const NEXT: &str = "see `cargo grade --doctor`; to grade your own work, leave --untrusted away";

/// The builder in the sandbox that the command line asks for, tried out: for one's own work in none.
pub fn isolated(builder: Builder, arguments: &Arguments) -> Result<Builder, NotIsolated> {
    match (arguments.isolation, arguments.untrusted) {
        (Some(level), _) => tried(&builder, level).map_err(|why| NotIsolated::Named { level, why }),
        (None, true) => best(&builder),
        (None, false) => Ok(builder),
    }
}

/// The builder in the best sandbox that is good enough for others' work.
pub fn best(builder: &Builder) -> Result<Builder, NotIsolated> {
    let mut missing = String::new();
    for level in Isolation::ALL.into_iter().filter(|level| *level >= LEAST) {
        match tried(builder, level) {
            Ok(builder) => return Ok(builder),
            Err(why) => writeln!(missing, "  {level}: {why}").expect("text takes text"),
        }
    }
    Err(NotIsolated::NoneGoodEnough { missing })
}

/// The builder at this level, if it holds.
pub fn tried(builder: &Builder, level: Isolation) -> Result<Builder, Shortfall> {
    let builder = builder.clone().within(Sandbox::at(level));
    if level > Isolation::None {
        builder.try_sandbox()?;
    }
    Ok(builder)
}
