//! GitHub Actions: a summary on the run's page, annotations on the student's lines, and nothing in
//! the log that the runner could take for a command of ours.

mod annotations;
mod commands;
mod summary;

pub use annotations::annotations;
pub use commands::{random_token, with_commands_stopped};
pub use summary::summary;
