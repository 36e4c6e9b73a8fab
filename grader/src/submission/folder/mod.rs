//! Reads the task files in a folder on disk and in all folders below it. Links are not followed, and
//! only regular files are read.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::archive::{self, is_archive_name};
use super::choice::{self, Candidate, join};
use super::error::{ambiguous, is_about_submission};
use super::{MAX_FILE_BYTES, SubmissionError, SubmissionFiles, TaskFileError, display_name};
use crate::disk::{self, Operation};
use crate::files::PathError;
use crate::handed_out::HandedOut;
use crate::system::{self, EntryKind, Folder};

/// The maximum number of levels of folders that are searched.
const MAX_DEPTH: usize = 12;
/// The maximum number of files and folders that are listed.
const MAX_ENTRIES: usize = 20_000;
/// The maximum number of folders with task files.
const MAX_CANDIDATES: usize = 32;

/// The contents of a submission's folder.
#[derive(Debug, Default)]
pub(super) struct Search {
    /// The folders and archives that have task files.
    pub(super) candidates: Vec<Candidate>,
    /// The names at the top level, in which what is not UTF-8 is replaced.
    pub(super) names: Vec<String>,
    /// The paths of links below the folder, with `/`.
    pub(super) links: Vec<String>,
    /// Folders and archives that cannot be read, or are below too many others.
    pub(super) errors: Vec<SubmissionError>,
    /// The names at the top level, as the system has them.
    top_level: Vec<OsString>,
    /// The number of files and folders that were listed.
    entries: usize,
}

/// Looks for task files in a folder and everything below it.
pub(super) fn search(
    path: &Path,
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let folder = Folder::open(path).map_err(|error| unreadable(path, error))?;
    let mut search = Search::default();
    search.visit(&folder, path, "", handed_out)?;
    Ok(search)
}

/// Looks for task files in a folder, and not below it.
pub(super) fn search_one(
    path: &Path,
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let io = |error: io::Error| unreadable(path, error);
    let folder = Folder::open(path).map_err(io)?;
    let names = list(&folder, path).map_err(io)?;
    let mut search = Search {
        names: names.iter().map(|name| shown(name)).collect(),
        ..Search::default()
    };
    let open = |name: &str| open(&folder, path, name);
    search.add_candidate(path, "", &utf8(&names), open, handed_out)?;
    Ok(search)
}

/// Looks for task files among these files, each given by its name and its path, and in the archives
/// among them.
pub(super) fn search_files(
    path: &Path,
    files: &[(String, PathBuf)],
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let mut search = Search {
        names: files.iter().map(|(name, _)| name.clone()).collect(),
        ..Search::default()
    };
    // Of several files with the same name, the last one counts.
    let open = |name: &str| {
        let file = files.iter().rfind(|(other, _)| other == name);
        file.map_or(Ok(None), |(_, path)| {
            disk::before(Operation::Read(path))?;
            system::open_regular_file(path)
        })
    };
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    search.add_candidate(path, "", &names, open, handed_out)?;
    for (name, path) in files {
        search.add_archive(name, path, handed_out);
    }
    Ok(search)
}

impl Search {
    /// Looks for task files in a single archive.
    pub(super) fn in_archive(
        path: &Path,
        handed_out: &'static HandedOut,
    ) -> Result<Self, SubmissionError> {
        let (candidates, names) = archive::candidates(path, "", handed_out)?;
        Ok(Search {
            candidates,
            names,
            ..Search::default()
        })
    }

    /// Adds the archives at the top level of the folder at `path`.
    pub(super) fn add_archives(&mut self, path: &Path, handed_out: &'static HandedOut) {
        for name in std::mem::take(&mut self.top_level) {
            let shown = shown(&name);
            if !self.links.contains(&shown) {
                self.add_archive(&shown, &path.join(&name), handed_out);
            }
        }
    }

    fn add_archive(&mut self, name: &str, path: &Path, handed_out: &'static HandedOut) {
        if is_archive_name(name) && path.is_file() {
            match archive::candidates(path, name, handed_out) {
                Ok((candidates, _)) => self.candidates.extend(candidates),
                Err(error) => self.errors.push(error),
            }
        }
    }

    /// Looks for task files in a folder, whose path is `below` the submission's, and everything
    /// below it.
    fn visit(
        &mut self,
        folder: &Folder,
        submission: &Path,
        below: &str,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        let io = |error: io::Error| unreadable(&submission.join(below), error);
        let names = list(folder, &submission.join(below)).map_err(io)?;
        self.entries += names.len();
        if self.entries > MAX_ENTRIES {
            return Err(SubmissionError::TooManyFiles(submission.to_owned()));
        }
        for name in &names {
            let shown = shown(name);
            let path = join(below, &shown);
            match folder.kind(name).map_err(io)? {
                EntryKind::Link => self.links.push(path),
                EntryKind::Folder if !choice::is_skipped(&shown, handed_out) => {
                    self.visit_subfolder(folder, name, submission, &path, handed_out)?;
                }
                EntryKind::Folder | EntryKind::File | EntryKind::Other => {}
            }
        }
        if below.is_empty() {
            self.names = names.iter().map(|name| shown(name)).collect();
            self.top_level.clone_from(&names);
        }
        let open = |name: &str| open(folder, &submission.join(below), name);
        self.add_candidate(submission, below, &utf8(&names), open, handed_out)
    }

    fn visit_subfolder(
        &mut self,
        folder: &Folder,
        name: &OsStr,
        submission: &Path,
        path: &str,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        if path.matches('/').count() >= MAX_DEPTH {
            let too_deep = SubmissionError::TooManyFiles(submission.to_owned());
            self.errors.push(too_deep);
            return Ok(());
        }
        match folder.subfolder(name) {
            Ok(Some(subfolder)) => self.visit(&subfolder, submission, path, handed_out),
            Ok(None) => Ok(()),
            Err(error) => {
                self.errors.push(unreadable(Path::new(path), error));
                Ok(())
            }
        }
    }

    /// Reads the files with these names if there is a task file among them.
    fn add_candidate(
        &mut self,
        submission: &Path,
        folder: &str,
        names: &[&str],
        open: impl Fn(&str) -> io::Result<Option<File>>,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        let found = choice::task_files(names, handed_out);
        let found = found.map_err(|error| ambiguous(submission, error))?;
        if found.is_empty() {
            return Ok(());
        }
        let mut files = SubmissionFiles::default();
        for (name, found_as) in &found {
            let read = read_file(open(found_as), name);
            let read = read.map_err(|error| unreadable(&submission.join(folder), error))?;
            files.task_files.insert(*name, read);
        }
        for &name in names {
            if name.ends_with(".rs") && !found.values().any(|used| *used == name) {
                let is_compared = handed_out.given_file(name).is_some();
                let bytes = is_compared.then(|| read_file(open(name), "a given file"));
                let bytes = bytes.transpose();
                let bytes = bytes.map_err(|error| unreadable(&submission.join(folder), error))?;
                let bytes = bytes.and_then(Result::ok).unwrap_or_default();
                files.other_files.insert(name.to_owned(), bytes);
            }
        }
        self.candidates.push(Candidate {
            folder: folder.to_owned(),
            files,
        });
        if self.candidates.len() > MAX_CANDIDATES {
            return Err(SubmissionError::TooManyFiles(submission.to_owned()));
        }
        Ok(())
    }
}

/// Returns a name with replacements for what is not UTF-8.
fn shown(name: &OsStr) -> String {
    name.to_string_lossy().into_owned()
}

/// Returns the names that are UTF-8, as all names of task files are.
fn utf8(names: &[OsString]) -> Vec<&str> {
    names.iter().filter_map(|name| name.to_str()).collect()
}

fn list(folder: &Folder, path: &Path) -> io::Result<Vec<OsString>> {
    disk::before(Operation::List(path))?;
    folder.names()
}

fn open(folder: &Folder, path: &Path, name: &str) -> io::Result<Option<File>> {
    disk::before(Operation::Read(&path.join(name)))?;
    folder.file(OsStr::new(name))
}

fn unreadable(path: &Path, error: io::Error) -> SubmissionError {
    let reason = if is_about_submission(&error) {
        SubmissionError::Unreadable
    } else {
        SubmissionError::Machine
    };
    reason(PathError {
        action: "read",
        path: PathBuf::from(display_name(&path.to_string_lossy())),
        source: error,
    })
}

/// Reads a file. The outer error is the machine's; the inner one costs the file's points.
fn read_file(
    opened: io::Result<Option<File>>,
    name: &'static str,
) -> io::Result<Result<Vec<u8>, TaskFileError>> {
    let read = || {
        let Some(file) = opened? else {
            return Ok(Err(TaskFileError::NotRegular(name)));
        };
        let mut bytes = Vec::new();
        file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
        Ok(Ok(bytes))
    };
    match read() {
        Err(error) if is_about_submission(&error) => Ok(Err(TaskFileError::Unreadable {
            name,
            why: error.kind().to_string(),
        })),
        read => read,
    }
}

#[cfg(test)]
mod tests;
