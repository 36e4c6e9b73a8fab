//! Collects the compiler errors and the notes on a submission's files for the score.

use crate::build::{Build, NotCompiled};
use crate::score::{BuildReport, FileReport};
use crate::submission::{Submission, TaskFileError};
use crate::verdict::messages::{file_line, file_message};

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
        for (methods, one, several) in [
            (
                missing,
                "is missing. Other code may need it, so put it back",
                "are missing. Other code may need them, so put them back",
            ),
            (
                changed,
                "was changed, which may cause items in any task to fail",
                "were changed, which may cause items in any task to fail",
            ),
        ] {
            let names: Vec<&str> = methods.iter().map(|method| method.name).collect();
            let names = names.join(", ");
            match methods.len() {
                0 => {}
                1 => notes.push(format!("{file}: the given method {names} {one}")),
                _ => notes.push(format!("{file}: the given methods {names} {several}")),
            }
        }
    }
    notes
}
