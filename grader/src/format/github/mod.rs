//! GitHub Actions: a summary on the page of the run, and annotations on the student's
//! lines.

mod annotations;
mod commands;
mod summary;

use crate::format::FormatSpec;

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "github",
    file: "github.md",
    // Other commands of the same step may have written to this file already.
    shared_file: Some("GITHUB_STEP_SUMMARY"),
    render: Some(summary::summary),
    runner_commands: Some(annotations::annotations),
    ..FormatSpec::EMPTY
};
