//! Reports compiler errors, and notes on a submission's files, in the score.

use crate::build::Build;
use crate::score::{BuildReport, FileReport};
use crate::submission::Submission;
use crate::verdict::{file_line, file_message};

/// Returns the compiler errors, and notes on the submission's files.
pub fn build_report(submission: &Submission, build: &Build) -> BuildReport {
    let not_compiled = build.not_compiled.iter().map(|(file, why)| FileReport {
        file: (*file).to_owned(),
        line: file_line(why),
        message: file_message(file, why),
    });
    BuildReport {
        not_compiled: not_compiled.collect(),
        notes: notes(submission, build),
    }
}

/// Returns notes on the submission's files that do not affect points.
fn notes(submission: &Submission, build: &Build) -> Vec<String> {
    let mut notes = submission.ignored_copies.clone();
    notes.extend(submission.notes.iter().cloned());
    let compiled = submission
        .files
        .iter()
        .filter(|(file, _)| !build.not_compiled.contains_key(file.name));
    for (file, text) in compiled {
        let changed = text.as_ref().map_or(Vec::new(), |text| {
            build.handed_out.changed_methods(file, text)
        });
        let names = |is_missing| {
            let changed = changed.iter();
            let names = changed.filter(|method| method.is_missing == is_missing);
            names
                .map(|method| method.name)
                .collect::<Vec<_>>()
                .join(", ")
        };
        let (missing, changed) = (names(true), names(false));
        if !missing.is_empty() {
            notes.push(format!(
                "{}: given methods are missing, which other code may need; put them back: {missing}",
                file.name
            ));
        }
        if !changed.is_empty() {
            notes.push(format!(
                "{}: given methods were changed, which by itself costs no points: {changed}",
                file.name
            ));
        }
    }
    notes
}
