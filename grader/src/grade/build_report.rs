//! Collects the compiler errors and the notes on a submission's files for the score.

use crate::build::{Build, NotCompiled};
use crate::score::{BuildReport, FileReport};
use crate::submission::{Submission, TaskFileError};
use crate::verdict::{file_line, file_message};

/// Returns the compiler errors and notes on the submission's files.
pub fn build_report(submission: &Submission, build: &Build) -> BuildReport {
    let not_compiled = build.not_compiled.iter().map(|(file, why)| FileReport {
        file: (*file).to_owned(),
        line: file_line(why),
        message: file_message(file, why),
        is_missing: matches!(why, NotCompiled::Unreadable(TaskFileError::Missing)),
    });
    BuildReport {
        not_compiled: not_compiled.collect(),
        ignored_copies: submission.ignored_copies.clone(),
        notes: notes(submission, build),
    }
}

/// Returns notes on the submission's files. These notes don't affect points.
fn notes(submission: &Submission, build: &Build) -> Vec<String> {
    let mut notes = submission.notes.clone();
    let compiled = submission
        .files
        .iter()
        .filter(|(file, _)| !build.not_compiled.contains_key(file.name));
    for (file, text) in compiled {
        let changed = text.as_ref().map_or(Vec::new(), |text| {
            build.handed_out.changed_methods(file, text)
        });
        let (missing, changed): (Vec<_>, Vec<_>) =
            changed.into_iter().partition(|method| method.is_missing);
        let file = file.name;
        for (methods, what) in [
            (
                missing,
                "are missing, but other code may need them: put them back",
            ),
            (
                changed,
                "were changed, which may cause items in any task to fail",
            ),
        ] {
            if !methods.is_empty() {
                let names: Vec<&str> = methods.iter().map(|method| method.name).collect();
                notes.push(format!(
                    "{file}: given methods {what}: {}",
                    names.join(", ")
                ));
            }
        }
    }
    notes
}
