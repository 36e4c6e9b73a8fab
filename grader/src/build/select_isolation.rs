//! Selects the isolation level for grading. If the requested level isn't available, nothing is
//! graded.

use crate::build::{Builder, SelfTestError};
use crate::error::Error;
use crate::sandbox::{Isolation, Sandbox};

/// The minimum level for other people's code unless a different level is requested.
pub const MIN_FOR_UNTRUSTED: Isolation = Isolation::NoNamespaces;

/// The requested isolation for a submission's code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum IsolationRequest {
    /// No isolation, for grading your own work.
    #[default]
    OwnWork,
    /// The best available level, which must be good enough for other people's code.
    Untrusted,
    /// Exactly this level.
    Level(Isolation),
}

const ADVICE: &str = "see `cargo grade --doctor`; to grade your own work, leave out --untrusted";

/// Tests the requested isolation and returns a builder that uses it. For
/// [`IsolationRequest::OwnWork`], the builder is returned unchanged.
pub fn with_requested_level(builder: Builder, request: IsolationRequest) -> Result<Builder, Error> {
    match request {
        IsolationRequest::OwnWork => Ok(builder),
        IsolationRequest::Untrusted => with_best_level(&builder),
        IsolationRequest::Level(level) => with_level(&builder, level).map_err(|why| {
            Error::Isolation(format!(
                "isolation level {level} is not available: {why}\n{ADVICE}"
            ))
        }),
    }
}

/// Returns a builder that uses the best available level, provided that this level is good enough
/// for other people's code.
pub fn with_best_level(builder: &Builder) -> Result<Builder, Error> {
    let mut missing = String::new();
    let levels = Isolation::ALL.into_iter();
    for level in levels.filter(|level| *level >= MIN_FOR_UNTRUSTED) {
        match with_level(builder, level) {
            Ok(builder) => return Ok(builder),
            Err(why) => missing += &format!("  {level}: {why}\n"),
        }
    }
    Err(Error::Isolation(format!(
        "other people's code cannot be graded here: that requires isolation level \
         {MIN_FOR_UNTRUSTED} or better, which is not available\n{missing}{ADVICE}"
    )))
}

/// Tests this level and returns a builder that uses it.
pub fn with_level(builder: &Builder, level: Isolation) -> Result<Builder, SelfTestError> {
    let builder = builder.clone().with_sandbox(Sandbox::at(level));
    if level > Isolation::None {
        builder.test_sandbox()?;
    }
    Ok(builder)
}
