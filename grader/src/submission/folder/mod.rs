//! Reads the task files in a folder on disk, its subfolders and the archives in them. Links aren't
//! followed, and only regular files are read.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::archive::{self, ArchiveBytes};
use super::candidate::{FileContents, is_starter, join};
use super::limit::Limit;
use super::names::is_archive_name;
use super::search::{FoundFolder, Search};
use super::skipped::is_skipped;
use super::{MAX_FILE_BYTES, SubmissionError, TaskFileError, display_name};
use crate::handed_out::HandedOut;
use crate::machine::disk::{self, Operation};
use crate::machine::files::{PathError, is_about_file};
use crate::machine::system::{self, EntryKind, Folder};

/// Searches a folder, its subfolders and the archives in them for task files.
pub(super) fn search(
    path: &Path,
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let mut search = Search::new(path, handed_out);
    search.visit(&open_folder(path)?, "")?;
    search.open_archives()?;
    Ok(search)
}

/// Searches a folder for task files, but not its subfolders.
pub(super) fn search_one(
    path: &Path,
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let mut search = Search::new(path, handed_out);
    let folder = open_folder(path)?;
    let names = list(&folder, path)?;
    search.read_folder("", &names, |name| open(&folder, path, name))?;
    Ok(search)
}

/// Searches these files, and the archives among them, for task files. Each file is specified by its
/// name and its path.
pub(super) fn search_files(
    path: &Path,
    files: &[(String, PathBuf)],
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let mut search = Search::new(path, handed_out);
    search.names = files.iter().map(|(name, _)| name.clone()).collect();
    search.spend(Limit::Files, files.len())?;
    let mut versions: BTreeMap<&str, Vec<&Path>> = BTreeMap::new();
    for (name, path) in files {
        versions.entry(name).or_default().push(path);
    }
    let mut paths: BTreeMap<OsString, &Path> = BTreeMap::new();
    for (name, versions) in versions {
        paths.insert(name.into(), search.last_version(name, &versions)?);
    }
    let open = |name: &OsStr| paths.get(name).map_or(Ok(None), |path| open_path(path));
    let names: Vec<OsString> = paths.keys().cloned().collect();
    search.read_folder("", &names, open)?;
    let archives = files
        .iter()
        .filter(|(name, path)| is_archive_name(name) && path.is_file());
    search.archives = archives.cloned().collect();
    search.open_archives()?;
    Ok(search)
}

/// Searches a single archive for task files.
pub(super) fn search_archive(
    path: &Path,
    handed_out: &'static HandedOut,
) -> Result<Search, SubmissionError> {
    let mut search = Search::new(path, handed_out);
    search.names = search.open_archive("", path)?;
    Ok(search)
}

impl Search {
    /// Opens the archives that were found.
    fn open_archives(&mut self) -> Result<(), SubmissionError> {
        let mut archives = std::mem::take(&mut self.archives);
        archives.sort();
        for (name, path) in archives {
            let found = self.open_archive(&name, &path);
            self.keep_error(&name, found)?;
        }
        Ok(())
    }

    /// Given the versions of a task file, returns the path of the last version that differs from
    /// the starter. If there is none, returns the path of the last version. Adds a note if an
    /// earlier version differs from both the starter and the returned version.
    fn last_version<'a>(
        &mut self,
        name: &str,
        versions: &[&'a Path],
    ) -> Result<&'a Path, SubmissionError> {
        let mut last = versions[versions.len() - 1];
        if versions.len() == 1 || self.handed_out.task_file(name).is_none() {
            return Ok(last);
        }
        self.spend(Limit::Copies, versions.len())?;
        let mut written: Vec<(&Path, FileContents)> = Vec::new();
        for path in versions {
            let read = read_file(open_path(path)).map_err(|error| unreadable(path, error))?;
            if !is_starter(name, &read, self.handed_out) {
                written.push((path, read));
            }
        }
        if let Some((path, graded)) = written.pop() {
            last = path;
            if written.iter().any(|(_, earlier)| *earlier != graded) {
                let note = "was handed in more than once: the last version is graded, and an \
                            earlier, different one is ignored";
                self.superseded.push(format!("{name} {note}"));
            }
        }
        Ok(last)
    }

    fn open_archive(&mut self, name: &str, path: &Path) -> Result<Vec<String>, SubmissionError> {
        let read = disk::before(Operation::Read(path));
        read.map_err(|error| unreadable(path, error))?;
        let found = archive::search(ArchiveBytes::File(path.to_owned()), name, self, 1);
        self.check_bytes()?;
        found
    }

    /// Searches a folder and its subfolders for task files. `below` is the folder's path relative
    /// to the submission.
    fn visit(&mut self, folder: &Folder, below: &str) -> Result<(), SubmissionError> {
        let path = self.submission.join(below);
        let names = list(folder, &path)?;
        self.spend(Limit::Files, names.len())?;
        let mut files = Vec::new();
        for name in &names {
            let shown = shown(name);
            let below = join(below, &shown);
            let kind = folder.kind(name);
            match kind.map_err(|error| unreadable(&path, error))? {
                EntryKind::Link => {
                    self.links.push(below);
                    files.push(name.clone());
                }
                EntryKind::Folder if !is_skipped(&shown, self.handed_out) => {
                    self.visit_subfolder(folder, name, &below)?;
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
        self.read_folder(below, &files, |name| open(folder, &path, name))
    }

    fn visit_subfolder(
        &mut self,
        folder: &Folder,
        name: &OsStr,
        path: &str,
    ) -> Result<(), SubmissionError> {
        let found = if path.matches('/').count() >= Limit::Levels.most() {
            Err(self.too_many(Limit::Levels))
        } else {
            match folder.subfolder(name) {
                Ok(Some(subfolder)) => return self.visit(&subfolder, path),
                Ok(None) => Ok(()),
                Err(error) => Err(unreadable(Path::new(path), error)),
            }
        };
        self.keep_error(path, found)
    }

    /// Of the files with these names, reads those that may be task files.
    fn read_folder(
        &mut self,
        path: &str,
        names: &[OsString],
        open: impl Fn(&OsStr) -> io::Result<Option<File>>,
    ) -> Result<(), SubmissionError> {
        let mut folder = FoundFolder {
            path: path.to_owned(),
            ..FoundFolder::default()
        };
        for name in names {
            let shown = shown(name);
            if is_archive_name(&shown) {
            } else if self.is_read(&shown) {
                self.spend(Limit::Copies, 1)?;
                let read = read_file(open(name));
                let read = read.map_err(|error| unreadable(&self.submission.join(path), error))?;
                folder.read.push((shown, read));
            } else {
                folder.others.push(shown);
            }
        }
        self.add_folder(folder)
    }
}

/// Returns a name with invalid UTF-8 replaced.
fn shown(name: &OsStr) -> String {
    name.to_string_lossy().into_owned()
}

fn open_folder(path: &Path) -> Result<Folder, SubmissionError> {
    Folder::open(path).map_err(|error| unreadable(path, error))
}

fn list(folder: &Folder, path: &Path) -> Result<Vec<OsString>, SubmissionError> {
    let names = disk::before(Operation::List(path)).and_then(|()| folder.names());
    names.map_err(|error| unreadable(path, error))
}

fn open_path(path: &Path) -> io::Result<Option<File>> {
    disk::before(Operation::Read(path))?;
    system::open_regular_file(path)
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

/// Reads a file. The outer error means that the machine is at fault. The inner error means that the
/// file gets no points.
fn read_file(opened: io::Result<Option<File>>) -> io::Result<FileContents> {
    let read = || {
        let Some(file) = opened? else {
            return Ok(Err(TaskFileError::NotRegular));
        };
        let mut bytes = Vec::new();
        file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
        Ok(Ok(bytes))
    };
    match read() {
        Err(error) if is_about_file(&error) => {
            Ok(Err(TaskFileError::Unreadable(error.kind().to_string())))
        }
        read => read,
    }
}

#[cfg(test)]
mod tests;
