//! Which files of a submission are not part of the program, and why.

use std::collections::BTreeMap;

use crate::build::diagnostics::Diagnostic;
use crate::given_files::TaskFile;
use crate::submission::{Submission, TaskFileError};

/// Why a file is not part of the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotCompiled {
    /// There is no text to compile.
    Unreadable(TaskFileError),
    /// It lacks something that other files call.
    MissingDeclaration(&'static str),
    /// The compiler's first error in it.
    Error {
        /// What it says.
        text: String,
        /// Where, counted from 1.
        line: Option<u32>,
    },
    /// The compiler did not finish, and did not say because of which file.
    Compiler(String),
}

impl NotCompiled {
    /// Whether it would be the same on any day.
    pub fn is_reproducible(&self) -> bool {
        match self {
            NotCompiled::Unreadable(
                TaskFileError::Missing(_)
                | TaskFileError::NotRegular(_)
                | TaskFileError::TooLong(_)
                | TaskFileError::NotText { .. },
            )
            | NotCompiled::MissingDeclaration(_)
            | NotCompiled::Error { .. } => true,
            NotCompiled::Unreadable(TaskFileError::Io { .. }) | NotCompiled::Compiler(_) => false,
        }
    }
}

/// Files that are not worth a compile: without text, or without what the others call.
pub(super) fn unusable_files(submission: &Submission) -> BTreeMap<&'static str, NotCompiled> {
    let why = |file: &TaskFile, text: &Result<String, TaskFileError>| match text {
        Err(unreadable) => Some(NotCompiled::Unreadable(unreadable.clone())),
        Ok(text) => {
            let lacking = file
                .required_declarations
                .iter()
                .find(|part| !text.contains(**part));
            lacking.map(|part| NotCompiled::MissingDeclaration(part))
        }
    };
    submission
        .files
        .iter()
        .filter_map(|(file, text)| Some((file.name, why(file, text)?)))
        .collect()
}

/// Notes each file that the errors name, with its first error. False if they name no new one.
pub(super) fn blame(
    errors: &[Diagnostic],
    not_compiled: &mut BTreeMap<&'static str, NotCompiled>,
) -> bool {
    let before = not_compiled.len();
    for error in errors {
        if let Some(name) = error.blamed_file() {
            let why = || NotCompiled::Error {
                text: error.text().to_owned(),
                line: error.line_in(name),
            };
            not_compiled.entry(name).or_insert_with(why);
        }
    }
    not_compiled.len() > before
}

/// Notes every file that is not noted yet, all for the same reason.
pub(super) fn blame_all(
    submission: &Submission,
    why: &str,
    not_compiled: &mut BTreeMap<&'static str, NotCompiled>,
) {
    for (file, _) in &submission.files {
        let why = || NotCompiled::Compiler(why.to_owned());
        not_compiled.entry(file.name).or_insert_with(why);
    }
}
