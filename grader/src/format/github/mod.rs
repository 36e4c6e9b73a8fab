//! GitHub Actions: a summary on the page of the run, annotations on the student's lines, and a log
//! in which a submission's output cannot be mistaken for a command.

mod annotations;
mod commands;
mod summary;

pub use annotations::annotations;
pub use commands::{random_token, with_commands_stopped};
pub use summary::summary;
