//! Determines which files in a submission cannot be compiled, and why.

use std::collections::BTreeMap;

use crate::build::compiler_help::SECTION_LABEL;
use crate::build::diagnostics::Diagnostic;
use crate::handed_out::{ChangedDeclaration, TaskFile, changed_declaration};
use crate::submission::{Submission, TaskFileError};

/// The beginning of the advice on a change that makes other files fail to compile.
pub const RESTORE_LABEL: &str = "Restore ";

/// The reason a file isn't part of the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotCompiled {
    /// The file is missing or unreadable.
    Unreadable(TaskFileError),
    /// The file lacks a declaration that other files use.
    MissingDeclaration(&'static str),
    /// The compiler's errors in the file.
    Error {
        /// The compiler's messages, with an empty line between them.
        text: String,
        /// Number of the line with the first error, counted from 1, or `None` if it is unknown.
        line: Option<u32>,
    },
    /// The compiler failed, and its messages name no file.
    Compiler(String),
}

impl NotCompiled {
    /// Combines a file's errors into the reason the file isn't compiled. Returns `None` if
    /// there are no errors.
    fn of_errors<'a>(file: &str, errors: impl Iterator<Item = &'a Diagnostic>) -> Option<Self> {
        let errors: Vec<&Diagnostic> = errors.collect();
        let first = errors.first()?;
        let mut texts = Vec::new();
        let mut sections = Vec::new();
        for error in &errors {
            texts.push(error.text().to_owned());
            // Name a section only after the first error that it explains.
            let section = error
                .section()
                .filter(|section| !sections.contains(section));
            texts.extend(
                section
                    .iter()
                    .map(|section| format!("{SECTION_LABEL}{}", section.location())),
            );
            sections.extend(section);
        }
        Some(NotCompiled::Error {
            text: texts.join("\n\n"),
            line: first.line_in(file),
        })
    }

    /// Returns whether compiling again would give the same result.
    pub fn is_reproducible(&self) -> bool {
        !matches!(
            self,
            NotCompiled::Unreadable(TaskFileError::Unreadable(_)) | NotCompiled::Compiler(_)
        )
    }
}

/// Returns the files that are rejected before compiling because they cannot be read.
pub(super) fn unreadable_files(submission: &Submission) -> BTreeMap<&'static str, NotCompiled> {
    let files = submission.files.iter();
    let why = files.filter_map(|(file, text)| {
        let why = text.as_ref().err()?;
        Some((file.name, NotCompiled::Unreadable(why.clone())))
    });
    why.collect()
}

/// Returns the files that seem to lack a declaration that other files use. The resulting errors in
/// the other files would hide the cause.
pub(super) fn incomplete_files(submission: &Submission) -> BTreeMap<&'static str, NotCompiled> {
    let why = |(file, text): &(TaskFile, Result<String, TaskFileError>)| {
        let text = text.as_ref().ok()?;
        let mut required = file.required_declarations.iter();
        let missing = required.find(|part| !text.contains(**part))?;
        Some((file.name, NotCompiled::MissingDeclaration(missing)))
    };
    submission.files.iter().filter_map(why).collect()
}

/// Replaces the reason for each of these files with the compiler's errors in that file, if there
/// are any. A compiler error, e.g. about a misspelt `struct`, is more helpful than the original
/// reason.
pub(super) fn explain(incomplete: &mut BTreeMap<&'static str, NotCompiled>, errors: &[Diagnostic]) {
    for (name, why) in incomplete {
        let in_file = errors.iter().filter(|error| error.originates_in(name));
        if let Some(errors) = NotCompiled::of_errors(name, in_file) {
            *why = errors;
        }
    }
}

/// Records each file that the errors mention, together with all errors in that file. Returns how
/// many of these files had not been recorded before.
pub(super) fn blame(
    errors: &[Diagnostic],
    submission: &Submission,
    not_compiled: &mut BTreeMap<&'static str, NotCompiled>,
) -> usize {
    let task_files = submission.handed_out.files;
    let before = not_compiled.len();
    for (file, text) in &submission.files {
        let of_file = errors
            .iter()
            .filter(|error| error.blamed_file(task_files) == Some(file.name));
        let Some(mut why) = NotCompiled::of_errors(file.name, of_file.clone()) else {
            continue;
        };
        let is_elsewhere = of_file.clone().any(|error| !error.originates_in(file.name));
        let text = text.as_ref().ok().filter(|_| is_elsewhere);
        let changed = text.and_then(|text| changed_declaration(file, text));
        let is_all_elsewhere = of_file
            .into_iter()
            .all(|error| error.line_of_text(file.name).is_none());
        if let NotCompiled::Error { text, .. } = &mut why
            && (changed.is_some() || is_all_elsewhere)
        {
            *text += &how_to_restore(file, changed);
        }
        not_compiled.entry(file.name).or_insert(why);
    }
    not_compiled.len() - before
}

/// Returns the reason for a file that causes all of these errors, although they may be in other
/// files.
pub(super) fn because_of(
    file: &TaskFile,
    submission: &Submission,
    errors: &[Diagnostic],
) -> NotCompiled {
    /// The maximum number of errors to show. Many share a cause.
    const MAX_ERRORS: usize = 3;
    let task_files = submission.handed_out.files;
    let about_source = errors.iter().filter(|error| error.is_about_source());
    let (mut shown, others): (Vec<&Diagnostic>, Vec<_>) =
        about_source.partition(|error| error.blamed_file(task_files) == Some(file.name));
    shown.extend(others);
    let shown = shown.into_iter().take(MAX_ERRORS);
    let mut why = NotCompiled::of_errors(file.name, shown)
        .unwrap_or_else(|| NotCompiled::Compiler(String::new()));
    if let NotCompiled::Error { text, line } = &mut why {
        let mut own = errors.iter().filter_map(|error| error.line_in(file.name));
        *line = line.or_else(|| own.next());
        let mut files = submission.files.iter();
        let own = files.find(|(other, _)| other.name == file.name);
        let own = own.and_then(|(_, own)| own.as_ref().ok());
        let changed = own.and_then(|own| changed_declaration(file, own));
        *text += &how_to_restore(file, changed);
    }
    why
}

/// Returns advice on a file that causes errors in other files.
fn how_to_restore(file: &TaskFile, changed: Option<ChangedDeclaration>) -> String {
    match changed {
        Some(ChangedDeclaration { now, handed_out }) => format!(
            "\n\n{RESTORE_LABEL}the starter's declaration in {}, which the given code relies on:\n  \
             now         {now}\n  handed out  {handed_out}",
            file.name
        ),
        None => format!(
            "\n\n{RESTORE_LABEL}anything you have changed or removed in {} that other files rely \
             on, such as a field, a method or a `derive`. If you have defined a type that the \
             given code already provides (`Ray`, for example), use the given one instead. Threads \
             share your types, so they can't contain a `Cell`, a `RefCell` or an `Rc`.",
            file.name
        ),
    }
}

/// Records the same reason for all remaining files.
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
