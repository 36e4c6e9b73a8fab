//! Collects a submission, i.e. only the assignment's task files, from a folder or an archive.
//!
//! An archive is read in memory and never unpacked. Files are selected by their exact names.

mod archive;
mod candidate;
mod choice;
mod error;
mod folder;
mod limit;
mod limited_reader;
mod names;
mod search;
mod skipped;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use judging::assignment::TaskInfo;
use judging::sanitize::sanitize_line;

use crate::handed_out::{HandedOut, TaskFile, TaskMethods, is_unwritten};
use crate::inputs::task_selection::suggestion_for_submission;
use crate::machine::files;

use candidate::{Candidate, Lookalike};
use search::Search;

pub use archive::{Archive, ArchiveError, ArchiveLimits, Listing, Member};
pub use error::{SubmissionError, TaskFileError, listed};
pub use limit::Limit;
pub use names::{copied_names, is_archive_name, may_be_task_file, strip_archive_extension};
pub use skipped::is_skipped_name;

/// The maximum length of a file to read, in bytes. The reference's files are about 10,000 bytes
/// long.
const MAX_FILE_BYTES: u64 = 1 << 20;
/// The maximum number of notes about other files in a report.
const MAX_NOTES: usize = 20;
/// The maximum length of a printed name, in characters.
const MAX_NAME_CHARS: usize = 200;

/// The task files as submitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// The assignment.
    pub handed_out: &'static HandedOut,
    /// The name of the folder or archive, for reports.
    pub name: String,
    /// The text of each task file, or the reason there is none. The files are in lecture order.
    pub files: Vec<(TaskFile, Result<String, TaskFileError>)>,
    /// Notes about files that look like task files or archives but aren't graded, or are graded
    /// under a different name.
    pub ignored_copies: Vec<String>,
    /// Notes about other files that were found but aren't graded.
    pub notes: Vec<String>,
}

impl Submission {
    /// Reads the task files in a folder or archive, at any depth, including those in nested
    /// archives. The folder with the most task files is used. If the files are spread over several
    /// folders, they are combined. Ignored copies are mentioned in a note.
    pub fn collect(path: &Path, handed_out: &'static HandedOut) -> Result<Self, SubmissionError> {
        let name = folder_name(path);
        if path.is_dir() {
            return Submission::choose(name, folder::search(path, handed_out)?);
        }
        if path.is_file() {
            let name = strip_archive_extension(&name).to_owned();
            return Submission::choose(name, folder::search_archive(path, handed_out)?);
        }
        Err(match path.symlink_metadata() {
            Ok(_) => SubmissionError::NotFileOrFolder(path.to_owned()),
            Err(_) => {
                let name = path.file_name().and_then(|name| name.to_str());
                let suggestion =
                    name.map(|name| suggestion_for_submission(name, handed_out.assignment));
                SubmissionError::NotFound {
                    path: path.to_owned(),
                    suggestion: suggestion.unwrap_or_default(),
                }
            }
        })
    }

    /// Reads the task files in the folder `src` of the package that students work in: the files
    /// that Cargo compiles, regardless of copies in other folders. If there is no such folder,
    /// searches for the files in the same way as [`Submission::collect`]. All assignments in the
    /// folder `student` have its name.
    pub fn collect_package(
        path: &Path,
        handed_out: &'static HandedOut,
    ) -> Result<Self, SubmissionError> {
        let source = path.join("src");
        let mut files = handed_out.file_names().map(|file| source.join(file));
        if files.any(|file| file.is_file()) {
            let mut search = folder::search_one(&source, handed_out)?;
            let copies = std::mem::take(&mut search.lookalikes);
            let depth = Path::new(handed_out.student).components().count();
            let student = path.ancestors().nth(depth - 1).unwrap_or(path);
            let mut own = Submission::choose(folder_name(student), search)?;
            let notes = own.notes_on_own_copies(&copies);
            own.ignored_copies.extend(notes);
            own.ignored_copies
                .extend(own.notes_on_misplaced_files(path));
            return Ok(own);
        }
        Submission::collect(path, handed_out)
    }

    /// Reads the task files among these files, including those in any archives. Each file is
    /// specified by its submitted name and its path on disk.
    pub fn from_files(
        name: &str,
        files: &[(String, PathBuf)],
        handed_out: &'static HandedOut,
    ) -> Result<Self, SubmissionError> {
        let search = folder::search_files(Path::new(name), files, handed_out)?;
        Submission::choose(name.to_owned(), search)
    }

    /// Chooses the folder to grade.
    fn choose(name: String, search: Search) -> Result<Self, SubmissionError> {
        let (path, handed_out) = (search.submission, search.handed_out);
        let link = |link: &String| SubmissionError::Link {
            path: path.clone(),
            link: display_name(link),
        };
        let (faults, errors): (Vec<_>, Vec<_>) = search
            .errors
            .into_iter()
            .partition(|(_, error)| error.is_machine_fault());
        // A file that the machine failed to read could be the one to grade.
        if let Some((_, fault)) = faults.into_iter().next() {
            return Err(fault);
        }
        let lookalikes = search.lookalikes.iter().map(|file| file.path.clone());
        let mut found: Vec<String> = lookalikes.collect();
        let has_other_names = !found.is_empty();
        let choice = choice::choose(&path, search.candidates, search.lookalikes, handed_out)?;
        let Some(mut choice) = choice else {
            let mut errors = errors.into_iter().map(|(_, error)| error);
            let error = errors.next().or_else(|| search.links.first().map(link));
            return Err(error.unwrap_or_else(|| {
                let names = search.names.into_iter();
                found.extend(names.filter(|name| !is_skipped_name(name)));
                let mut seen = BTreeSet::new();
                found.retain(|name| seen.insert(name.clone()));
                let advice = format!(
                    ": name each file exactly like its task file, such as {}; names must end in \
                     .rs",
                    handed_out.files[0].name
                );
                SubmissionError::NoTaskFiles {
                    path: path.clone(),
                    files: handed_out.file_list(),
                    found,
                    advice: if has_other_names {
                        advice
                    } else {
                        String::new()
                    },
                }
            }));
        };
        choice.notes.extend(search.superseded);
        // A link could lead to another person's files.
        let files = handed_out.file_names();
        let mut paths = files.map(|file| choice.chosen.path_of(file));
        if let Some(path) = paths.find(|path| search.links.contains(path)) {
            return Err(link(&path));
        }
        // The missing files could be in a folder or archive that cannot be read, or behind a link.
        if !choice.is_complete {
            let mut links = search.links.iter();
            let leads_to_files = |path: &&String| may_lead_to_files(path, handed_out);
            let error = errors.into_iter().map(|(_, error)| error).next();
            let error = error.or_else(|| links.find(leads_to_files).map(link));
            if let Some(error) = error {
                return Err(error);
            }
        } else {
            let notes = errors.iter().map(|(path, error)| not_graded(path, error));
            choice.notes.extend(notes.take(MAX_NOTES));
        }
        let Candidate {
            mut task_files,
            other_files,
            ..
        } = choice.chosen;
        let mut text = |file: TaskFile| {
            let bytes = task_files.remove(file.name);
            decode(bytes.unwrap_or(Err(TaskFileError::Missing))?)
        };
        let files = handed_out.files.iter().map(|file| (*file, text(*file)));
        Ok(Submission {
            handed_out,
            name,
            files: files.collect(),
            ignored_copies: choice.notes,
            notes: notes(&other_files, handed_out),
        })
    }

    /// Returns notes about copies of students' own task files, which Cargo doesn't compile. Copies
    /// made by `cargo grade --reset` are left out.
    fn notes_on_own_copies(&self, copies: &[Lookalike]) -> Vec<String> {
        let differs = |copy: &&Lookalike| {
            let graded = self.text(copy.file).map(str::as_bytes);
            !copy.path.contains(".bak-") && graded != copy.contents.as_deref().ok()
        };
        let copies = copies.iter().filter(differs).take(MAX_NOTES);
        let note = |copy: &Lookalike| {
            display_name(&format!(
                "{} is not graded: only {} is",
                copy.path, copy.file
            ))
        };
        copies.map(note).collect()
    }

    /// Returns a note on each of the student's task files that is next to the package's folder
    /// `src`, or in a folder inside it. Cargo doesn't compile these files.
    fn notes_on_misplaced_files(&self, package: &Path) -> Vec<String> {
        let source = package.join("src");
        let inside = files::read_dir(&source).unwrap_or_default();
        let mut folders: Vec<PathBuf> = inside.into_iter().filter(|path| path.is_dir()).collect();
        folders.sort();
        folders.insert(0, package.to_owned());
        let shown = |path: &Path| {
            let path = path.strip_prefix(package).unwrap_or(path);
            let parts = path.iter().map(|part| part.to_string_lossy());
            let parts = std::iter::once(Cow::from(&self.name)).chain(parts);
            display_name(&parts.collect::<Vec<_>>().join("/"))
        };
        let mut notes = Vec::new();
        for (folder, file) in folders
            .iter()
            .flat_map(|folder| self.handed_out.files.iter().map(move |file| (folder, file)))
        {
            let path = folder.join(file.name);
            let text = files::read_if_exists(&path).ok().flatten();
            let is_own =
                |text: &str| Some(text) != self.text(file.name) && !is_unwritten(file, text);
            if text.is_some_and(|text| is_own(&text)) {
                let graded = shown(&source.join(file.name));
                notes.push(format!("{} is not graded: only {graded} is", shown(&path)));
            }
        }
        notes.truncate(MAX_NOTES);
        notes
    }

    /// Returns the text of the task file with this name, if any.
    pub fn text(&self, name: &str) -> Option<&str> {
        let mut files = self.files.iter();
        let (_, text) = files.find(|(file, _)| file.name == name)?;
        text.as_deref().ok()
    }

    /// Returns a task's method, if it is found.
    pub fn task_methods(&self, task: &TaskInfo) -> Option<TaskMethods> {
        let text = self.text(task.file)?;
        self.handed_out.task_methods(task.task(), text).ok()
    }

    /// Returns whether the assignment hasn't been started: every task file is the starter's, token
    /// for token.
    pub fn is_as_handed_out(&self) -> bool {
        let mut files = self.files.iter();
        files.all(|(file, text)| text.as_ref().is_ok_and(|text| is_unwritten(file, text)))
    }
}

/// Returns whether a link is named like a task file or a folder that people hand in.
fn may_lead_to_files(link: &str, handed_out: &HandedOut) -> bool {
    let name = link.rsplit('/').next().unwrap_or(link);
    let mut folders = handed_out.assignment.folders.iter();
    may_be_task_file(name, handed_out)
        || folders.any(|folder| folder.split('/').any(|part| part == name))
}

/// Returns a note about a folder or an archive that was not read.
fn not_graded(path: &str, error: &SubmissionError) -> String {
    let why = if let SubmissionError::Archive { why, .. } = error {
        why.to_string()
    } else if let SubmissionError::Unreadable(error) = error {
        error.reason()
    } else if let SubmissionError::TooMany(_, limit) = error {
        format!("it has {limit}")
    } else {
        error.to_string()
    };
    format!("{} is not graded: {why}", display_name(path))
}

/// Returns a name that is safe to print: shortened, and with control characters escaped.
fn display_name(name: &str) -> String {
    sanitize_line(name, MAX_NAME_CHARS)
}

/// Returns the name of a folder or file, after resolving paths such as `student/.`.
fn folder_name(path: &Path) -> String {
    let resolved = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let name = resolved.file_name().unwrap_or(resolved.as_os_str());
    name.to_string_lossy().into_owned()
}

fn decode(bytes: Vec<u8>) -> Result<String, TaskFileError> {
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(TaskFileError::TooLong);
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|byte| **byte == b'\n').count();
        TaskFileError::NotText(line)
    })?;
    match text.trim() {
        "" => Err(TaskFileError::Empty),
        _ => Ok(text),
    }
}

/// Returns notes that list the other files found and say that they aren't used.
fn notes(other_files: &BTreeMap<String, Vec<u8>>, handed_out: &HandedOut) -> Vec<String> {
    let note = |(name, bytes): (&String, &Vec<u8>)| match handed_out.given_file(name) {
        // `main.rs` only renders pictures, and the reference's may differ because it imports
        // another crate.
        Some(given) if *given == handed_out.main => None,
        Some(given) => {
            let theirs = String::from_utf8_lossy(bytes);
            // Compare line by line, because Git and editors may change line endings.
            let same = theirs.lines().eq(given.text.lines());
            (!same).then(|| {
                format!("{name} differs from the given file, which is used instead of yours")
            })
        }
        None => Some(format!(
            "{} is not one of the task files and is ignored",
            display_name(name)
        )),
    };
    other_files
        .iter()
        .filter_map(note)
        .take(MAX_NOTES)
        .collect()
}

#[cfg(test)]
mod tests;
