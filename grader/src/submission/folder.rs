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
    /// The names at the top level.
    pub(super) names: Vec<String>,
    /// The paths of links below the folder, with `/`.
    pub(super) links: Vec<String>,
    /// Folders and archives that cannot be read, or are below too many others.
    pub(super) errors: Vec<SubmissionError>,
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
        names: names
            .into_iter()
            .filter_map(|n| n.into_string().ok())
            .collect(),
        ..Search::default()
    };
    let names = search.names.clone();
    let open = |name: &str| open(&folder, path, name);
    search.add_candidate(path, "", &names, open, handed_out)?;
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
    let names = search.names.clone();
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
        for name in self.names.clone() {
            if !self.links.contains(&name) {
                self.add_archive(&name, &path.join(&name), handed_out);
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
        // A name that is not UTF-8 is no task file's, nor on the way to one.
        let names: Vec<String> = names
            .into_iter()
            .filter_map(|n| n.into_string().ok())
            .collect();
        for name in &names {
            let path = join(below, name);
            match folder.kind(OsStr::new(name)).map_err(io)? {
                EntryKind::Link => self.links.push(path),
                EntryKind::Folder if !choice::is_skipped(name, handed_out) => {
                    self.visit_subfolder(folder, submission, &path, handed_out)?;
                }
                EntryKind::Folder | EntryKind::File | EntryKind::Other => {}
            }
        }
        if below.is_empty() {
            self.names.clone_from(&names);
        }
        let open = |name: &str| open(folder, &submission.join(below), name);
        self.add_candidate(submission, below, &names, open, handed_out)
    }

    fn visit_subfolder(
        &mut self,
        folder: &Folder,
        submission: &Path,
        path: &str,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        if path.matches('/').count() >= MAX_DEPTH {
            let too_deep = SubmissionError::TooManyFiles(submission.to_owned());
            self.errors.push(too_deep);
            return Ok(());
        }
        let name = path.rsplit('/').next().unwrap_or(path);
        match folder.subfolder(OsStr::new(name)) {
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
        names: &[String],
        open: impl Fn(&str) -> io::Result<Option<File>>,
        handed_out: &'static HandedOut,
    ) -> Result<(), SubmissionError> {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let found = choice::task_files(&names, handed_out);
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
        for name in names {
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
mod tests {
    use std::fs;
    use std::io::ErrorKind;

    use tempfile::TempDir;

    use super::*;
    use crate::handed_out::RAYS;
    use crate::submission::Submission;

    /// Returns a folder with these files, each given by its path and its text.
    fn folder(files: &[(&str, &[u8])]) -> TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (path, bytes) in files {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        folder
    }

    /// Returns the folders in which a search has found task files.
    fn found(files: &[(&str, &[u8])]) -> Vec<String> {
        let folder = folder(files);
        let search = search(folder.path(), &RAYS).unwrap();
        let candidates = search.candidates.into_iter();
        candidates.map(|candidate| candidate.folder).collect()
    }

    fn tar(files: &[(&str, &[u8])]) -> Vec<u8> {
        let mut builder = tar::Builder::new(Vec::new());
        for (path, bytes) in files {
            let mut header = tar::Header::new_gnu();
            header.set_size(bytes.len() as u64);
            header.set_mode(0o644);
            builder.append_data(&mut header, path, *bytes).unwrap();
        }
        builder.into_inner().unwrap()
    }

    #[test]
    fn folders_of_tools_and_of_the_project_are_not_searched() {
        let files: [(&str, &[u8]); 4] = [
            ("src/bvh.rs", b"new"),
            ("target/bvh.rs", b""),
            ("grader/starter/bvh.rs", b""),
            (".git/bvh.rs", b""),
        ];
        assert_eq!(found(&files), ["src"]);
    }

    #[test]
    fn folders_are_searched_down_to_a_limit() {
        let path = |levels: usize| format!("{}bvh.rs", "a/".repeat(levels));
        assert_eq!(found(&[(&path(MAX_DEPTH), b"new")]).len(), 1);
        let deeper = folder(&[(&path(MAX_DEPTH + 1), b"new")]);
        let search = search(deeper.path(), &RAYS).unwrap();
        assert!(search.candidates.is_empty());
        assert!(matches!(
            search.errors[..],
            [SubmissionError::TooManyFiles(_)]
        ));
    }

    #[test]
    fn files_are_counted_up_to_a_limit() {
        let three = folder(&[("a", b""), ("b", b""), ("c", b"")]);
        let visit = |entries: usize| {
            let mut search = Search {
                entries,
                ..Search::default()
            };
            let folder = Folder::open(three.path()).unwrap();
            search.visit(&folder, three.path(), "", &RAYS)
        };
        assert!(visit(MAX_ENTRIES - 3).is_ok());
        assert!(matches!(
            visit(MAX_ENTRIES - 2),
            Err(SubmissionError::TooManyFiles(_))
        ));
    }

    #[test]
    fn folders_with_task_files_are_counted_up_to_a_limit() {
        let copies = |count: usize| {
            let paths: Vec<String> = (0..count).map(|n| format!("{n}/bvh.rs")).collect();
            let files: Vec<(&str, &[u8])> = paths
                .iter()
                .map(|path| (path.as_str(), &b"new"[..]))
                .collect();
            search(folder(&files).path(), &RAYS).map(|search| search.candidates.len())
        };
        assert_eq!(copies(MAX_CANDIDATES).unwrap(), MAX_CANDIDATES);
        let refused = copies(MAX_CANDIDATES + 1);
        assert!(matches!(refused, Err(SubmissionError::TooManyFiles(_))));
    }

    #[test]
    fn a_file_that_is_too_long_costs_only_its_own_points() {
        let long = vec![b' '; 1 + (1 << 20)];
        let folder = folder(&[("bvh.rs", &long), ("sphere.rs", b"new")]);
        let submission = Submission::collect(folder.path(), &RAYS).unwrap();
        let text = |name: &str| {
            let mut files = submission.files.iter();
            files.find(|(file, _)| file.name == name).unwrap().1.clone()
        };
        assert_eq!(text("bvh.rs"), Err(TaskFileError::TooLong("bvh.rs")));
        assert_eq!(text("sphere.rs"), Ok("new".to_owned()));
    }

    #[test]
    fn only_faults_of_the_machine_stop_the_search() {
        let read = |kind: ErrorKind| read_file(Err(kind.into()), "bvh.rs");
        let name = "bvh.rs";
        let why = "permission denied".to_owned();
        let denied = Err(TaskFileError::Unreadable { name, why });
        assert_eq!(read(ErrorKind::PermissionDenied).unwrap(), denied);
        assert_eq!(
            read(ErrorKind::TimedOut).unwrap_err().kind(),
            ErrorKind::TimedOut
        );
        let not_regular = read_file(Ok(None), name).unwrap();
        assert_eq!(not_regular, Err(TaskFileError::NotRegular(name)));
        let unreadable = |kind: ErrorKind| unreadable("a".as_ref(), kind.into());
        assert!(!unreadable(ErrorKind::NotFound).is_machine_fault());
        assert!(unreadable(ErrorKind::TimedOut).is_machine_fault());
    }

    #[test]
    fn archives_in_a_platforms_folder_are_read_like_folders() {
        let archive = tar(&[("src/bvh.rs", b"new")]);
        let folder = folder(&[
            ("work.tar", &archive),
            ("notes.txt", b"neither code nor an archive"),
            ("old.zip/readme", b"a folder"),
        ]);
        let submission = Submission::collect_with_archives(folder.path(), &RAYS).unwrap();
        let texts = submission
            .files
            .iter()
            .filter_map(|(_, text)| text.as_deref().ok());
        assert_eq!(texts.collect::<Vec<_>>(), ["new"]);
        // Without them, there is nothing to grade.
        let none = Submission::collect(folder.path(), &RAYS);
        assert!(matches!(none, Err(SubmissionError::NoTaskFiles { .. })));
    }

    #[test]
    fn an_archive_that_cannot_be_read_could_have_what_is_missing() {
        let folder = folder(&[("bvh.rs", b"new"), ("rest.zip", b"PK\x03\x04")]);
        let refused = Submission::collect_with_archives(folder.path(), &RAYS);
        assert!(matches!(refused, Err(SubmissionError::Archive { .. })));
    }

    #[cfg(unix)]
    #[test]
    fn archives_behind_links_are_not_read() {
        let elsewhere = folder(&[("work.tar", &tar(&[("bvh.rs", b"another's")]))]);
        let folder = folder(&[("sphere.rs", b"new")]);
        let link = folder.path().join("work.tar");
        system::symlink(&elsewhere.path().join("work.tar"), &link).unwrap();
        let submission = Submission::collect_with_archives(folder.path(), &RAYS).unwrap();
        let texts = submission
            .files
            .iter()
            .filter_map(|(_, text)| text.as_deref().ok());
        assert_eq!(texts.collect::<Vec<_>>(), ["new"]);
    }

    #[test]
    fn the_names_in_an_archive_without_task_files_are_listed() {
        let folder = folder(&[(
            "a.tar",
            &tar(&[("b/c.rs", b""), ("b/d", b""), ("a.txt", b"")]),
        )]);
        let error = Submission::collect(&folder.path().join("a.tar"), &RAYS).unwrap_err();
        assert!(error.to_string().ends_with("it has a.txt, b"), "{error}");
    }

    #[test]
    fn a_single_folder_is_searched_without_those_below() {
        let folder = folder(&[("bvh.rs", b"new"), ("old/bvh.rs", b"old")]);
        let search = search_one(folder.path(), &RAYS).unwrap();
        assert_eq!(search.candidates.len(), 1);
        assert!(search.names.contains(&"bvh.rs".to_owned()));
    }
}
