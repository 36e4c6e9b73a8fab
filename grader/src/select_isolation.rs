//! Which isolation a submission is graded with: what was asked for, or no grading at all.

use std::fmt::Write;

use crate::build::{Builder, SelfTestError};
use crate::cli::Arguments;
use crate::sandbox::{Isolation, Sandbox};

/// The least for code that is not one's own, unless another level is named.
pub const MIN_FOR_UNTRUSTED: Isolation = Isolation::NoNamespaces;

/// What was asked for is not to be had here.
#[derive(Debug, thiserror::Error)]
pub enum IsolationError {
    /// The level that was named.
    #[error("isolation {level} is not reached: {why}\n{ADVICE}")]
    LevelUnavailable {
        /// Which.
        level: Isolation,
        /// Why.
        why: SelfTestError,
    },
    /// None of those that are good enough.
    #[error(
        "others' code is not graded here: isolation is worse than {MIN_FOR_UNTRUSTED}\n{missing}{ADVICE}"
    )]
    NoSufficientLevel {
        /// A line for each that was tried.
        missing: String,
    },
}

const ADVICE: &str = "see `cargo grade --doctor`; to grade your own work, leave --untrusted away";

/// The builder in the sandbox that the command line asks for, tried out: for one's own work in none.
pub fn with_requested_level(
    builder: Builder,
    arguments: &Arguments,
) -> Result<Builder, IsolationError> {
    match (arguments.isolation, arguments.untrusted) {
        (Some(level), _) => with_level(&builder, level)
            .map_err(|why| IsolationError::LevelUnavailable { level, why }),
        (None, true) => with_best_level(&builder),
        (None, false) => Ok(builder),
    }
}

/// The builder in the best sandbox that is good enough for others' work.
pub fn with_best_level(builder: &Builder) -> Result<Builder, IsolationError> {
    let mut missing = String::new();
    for level in Isolation::ALL
        .into_iter()
        .filter(|level| *level >= MIN_FOR_UNTRUSTED)
    {
        match with_level(builder, level) {
            Ok(builder) => return Ok(builder),
            Err(why) => writeln!(missing, "  {level}: {why}").expect("text takes text"),
        }
    }
    Err(IsolationError::NoSufficientLevel { missing })
}

/// The builder at this level, if it holds.
pub fn with_level(builder: &Builder, level: Isolation) -> Result<Builder, SelfTestError> {
    let builder = builder.clone().with_sandbox(Sandbox::at(level));
    if level > Isolation::None {
        builder.test_sandbox()?;
    }
    Ok(builder)
}
