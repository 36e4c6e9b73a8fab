//! The programs around a submission: the probe that answers the grader, and the command line that
//! renders pictures.

pub mod answer;
pub mod attempt;
#[cfg(feature = "cli")]
pub mod cli;
pub mod lighting;
pub mod probe;
mod system;
#[cfg(feature = "cli")]
pub mod view;
