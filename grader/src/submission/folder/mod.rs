//! Reads the task files in a folder on disk and in all folders below it, and in the archives there.
//! Links are not followed, and only regular files are read.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::archive::{self, ArchiveBytes};
use super::budget::Limit;
use super::choice::{self, join};
use super::found::{FoundFolder, is_read};
use super::names::is_archive_name;
use super::search::Search;
use super::{MAX_FILE_BYTES, SubmissionError, TaskFileError, display_name};
use crate::handed_out::HandedOut;
use crate::machine::disk::{self, Operation};
use crate::machine::files::{PathError, is_about_file};
use crate::machine::system::{self, EntryKind, Folder};

/// The maximum number of levels of folders that are searched.
const MAX_DEPTH: usize = 12;

/// Looks for task files in a folder and everything below it, and in the archives there.
pub(super) fn search(
    path: &Path,
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let folder = Folder::open(path).map_err(|error| unreadable(path, error))?;
    let mut search = Search::new(path);
    search.visit(&folder, "", handed_out)?;
    search.open_archives(handed_out)?;
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
    let mut search = Search::new(path);
    search.names = names.iter().map(|name| shown(name)).collect();
    let open = |name: &OsStr| open(&folder, path, name);
    search.read_folder("", &names, open, handed_out)?;
    Ok(search)
}

/// Looks for task files among these files, each given by its name and its path, and in the archives
/// among them.
pub(super) fn search_files(
    path: &Path,
    files: &[(String, PathBuf)],
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let mut search = Search::new(path);
    search.names = files.iter().map(|(name, _)| name.clone()).collect();
    // Of several files with the same name, the last one counts.
    let open = |name: &OsStr| {
        let file = files.iter().rfind(|(other, _)| OsStr::new(other) == name);
        file.map_or(Ok(None), |(_, path)| {
            disk::before(Operation::Read(path))?;
            system::open_regular_file(path)
        })
    };
    let names: BTreeSet<OsString> = files.iter().map(|(name, _)| name.into()).collect();
    let names: Vec<OsString> = names.into_iter().collect();
    search.spend(Limit::Files, files.len())?;
    search.read_folder("", &names, open, handed_out)?;
    let archives = files
        .iter()
        .filter(|(name, path)| is_archive_name(name) && path.is_file());
    search.archives = archives.cloned().collect();
    search.open_archives(handed_out)?;
    Ok(search)
}

/// Looks for task files in a single archive.
pub(super) fn search_archive(
    path: &Path,
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let mut search = Search::new(path);
    search.names = search.open_archive("", path, handed_out)?;
    Ok(search)
}

impl Search {
    /// Opens the archives that were found.
    fn open_archives(&mut self, handed_out: &'static HandedOut) -> Result<(), SubmissionError> {
        let mut archives = std::mem::take(&mut self.archives);
        archives.sort();
        for (name, path) in archives {
            let found = self.open_archive(&name, &path, handed_out);
            self.keep_error(&name, found)?;
        }
        Ok(())
    }

    fn open_archive(
        &mut self,
        name: &str,
        path: &Path,
        handed_out: &'static HandedOut,
    ) -> Result<Vec<String>, SubmissionError> {
        let read = disk::before(Operation::Read(path));
        read.map_err(|error| unreadable(path, error))?;
        let found = archive::search(ArchiveBytes::File(path.to_owned()), name, self, handed_out);
        self.check_bytes()?;
        found
    }

    /// Looks for task files in a folder, whose path is `below` the submission's, and everything
    /// below it.
    fn visit(
        &mut self,
        folder: &Folder,
        below: &str,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        let path = self.submission.join(below);
        let io = |error: io::Error| unreadable(&path, error);
        let names = list(folder, &path).map_err(io)?;
        self.spend(Limit::Files, names.len())?;
        let mut files = Vec::new();
        for name in &names {
            let shown = shown(name);
            let below = join(below, &shown);
            match folder.kind(name).map_err(io)? {
                EntryKind::Link => {
                    self.links.push(below);
                    files.push(name.clone());
                }
                EntryKind::Folder if !choice::is_skipped(&shown, handed_out) => {
                    self.visit_subfolder(folder, name, &below, handed_out)?;
                    files.push(name.clone());
                }
                EntryKind::File if is_archive_name(&shown) => {
                    self.archives.push((below, path.join(name)));
                }
                EntryKind::Folder => {}
                EntryKind::File | EntryKind::Other => files.push(name.clone()),
            }
        }
        if below.is_empty() {
            self.names = names.iter().map(|name| shown(name)).collect();
        }
        let open = |name: &OsStr| open(folder, &path, name);
        self.read_folder(below, &files, open, handed_out)
    }

    fn visit_subfolder(
        &mut self,
        folder: &Folder,
        name: &OsStr,
        path: &str,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        let found = if path.matches('/').count() >= MAX_DEPTH {
            Err(SubmissionError::TooMany(
                self.submission.clone(),
                Limit::Levels,
            ))
        } else {
            match folder.subfolder(name) {
                Ok(Some(subfolder)) => return self.visit(&subfolder, path, handed_out),
                Ok(None) => Ok(()),
                Err(error) => Err(unreadable(Path::new(path), error)),
            }
        };
        self.keep_error(path, found)
    }

    /// Reads the files with these names that may be task files.
    fn read_folder(
        &mut self,
        path: &str,
        names: &[OsString],
        open: impl Fn(&OsStr) -> io::Result<Option<File>>,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        let mut folder = FoundFolder::new(path.to_owned());
        for name in names {
            let shown = shown(name);
            if is_archive_name(&shown) {
            } else if is_read(&shown, handed_out) {
                self.spend(Limit::Copies, 1)?;
                let read = read_file(
                    open(name),
                    handed_out
                        .task_file(&shown)
                        .map_or("a copy", |file| file.name),
                );
                let read = read.map_err(|error| unreadable(&self.submission.join(path), error))?;
                folder.read.push((shown, read));
            } else {
                folder.others.push(shown);
            }
        }
        self.add_folder(folder, handed_out)
    }
}

/// Returns a name with replacements for what is not UTF-8.
fn shown(name: &OsStr) -> String {
    name.to_string_lossy().into_owned()
}

fn list(folder: &Folder, path: &Path) -> io::Result<Vec<OsString>> {
    disk::before(Operation::List(path))?;
    folder.names()
}

fn open(folder: &Folder, path: &Path, name: &OsStr) -> io::Result<Option<File>> {
    disk::before(Operation::Read(&path.join(name)))?;
    folder.file(name)
}

fn unreadable(path: &Path, error: io::Error) -> SubmissionError {
    let reason = if is_about_file(&error) {
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
        Err(error) if is_about_file(&error) => Ok(Err(TaskFileError::Unreadable {
            name,
            why: error.kind().to_string(),
        })),
        read => read,
    }
}

#[cfg(test)]
mod tests;
