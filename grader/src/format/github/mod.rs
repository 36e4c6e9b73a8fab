//! GitHub Actions: a summary on the run's page and annotations in the student's code.

mod annotations;
mod commands;
mod summary;

use crate::format::FormatSpec;

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "github",
    file: "github.md",
    // Other commands in the same step may have written to this file already.
    shared_file: Some("GITHUB_STEP_SUMMARY"),
    render: Some(summary::summary),
    runner_commands: Some(annotations::annotations),
    ..FormatSpec::EMPTY
};
