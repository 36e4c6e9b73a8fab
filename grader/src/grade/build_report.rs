//! What the score says of a submission's files.

use crate::build::Build;
use crate::score::{BuildReport, FileReport};
use crate::submission::Submission;
use crate::verdict::{file_line, file_message};

/// What did not compile, and what else is to be said.
pub(super) fn build_report(submission: &Submission, build: &Build) -> BuildReport {
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

/// What is worth knowing of a submission's files and costs nothing.
fn notes(submission: &Submission, build: &Build) -> Vec<String> {
    let mut notes = submission.notes.clone();
    let compiled = submission
        .files
        .iter()
        .filter(|(file, _)| !build.not_compiled.contains_key(file.name));
    for (file, text) in compiled {
        let changed = text
            .as_ref()
            .map_or(Vec::new(), |text| file.changed_methods(text));
        if !changed.is_empty() {
            let (file, changed) = (file.name, changed.join(", "));
            notes.push(format!(
                "{file}: given methods were changed, at no cost by itself: {changed}"
            ));
        }
    }
    notes
}
