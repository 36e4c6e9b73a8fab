//! Reads a submission from a folder on disk. Links are not followed, and only regular files are
//! read.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::source_folder::{self, AmbiguousSource};
use super::{
    MAX_FILE_BYTES, SubmissionError, SubmissionFiles, TaskFileError, display_name, no_task_files,
};
use crate::handed_out::{HandedOut, TaskFile};
use crate::system::{self, EntryKind, Folder};

/// Reads the task files of a folder, and the Rust files beside them.
pub(super) fn read(
    path: &Path,
    handed_out: &'static HandedOut,
) -> Result<SubmissionFiles, SubmissionError> {
    let io = |error: io::Error| SubmissionError::Io {
        path: path.to_owned(),
        why: error.kind().to_string(),
    };
    let link = |link: &str| SubmissionError::Link {
        path: path.to_owned(),
        link: display_name(link),
    };
    let folder = Folder::open(path).map_err(io)?;
    let found = search(&folder, handed_out).map_err(io)?;
    let source = source_folder::find(found.files.iter().map(String::as_str), handed_out);
    let source = source.map_err(|AmbiguousSource(folders)| SubmissionError::Ambiguous {
        path: path.to_owned(),
        folders,
    })?;
    let Some(source) = source else {
        return Err(match found.linked_folders.first() {
            Some(first) => link(first),
            None => no_task_files(path, handed_out),
        });
    };
    // A link could lead to another person's files.
    if let Some((_, first)) = found.links.iter().find(|(folder, _)| *folder == source) {
        return Err(link(first));
    }
    let Subfolder::Found(source) = open_below(&folder, &source).map_err(io)? else {
        return Err(no_task_files(path, handed_out));
    };
    let names = source.names().map_err(io)?;
    let names: Vec<String> = names
        .into_iter()
        .filter_map(|name| name.into_string().ok())
        .collect();
    let files = names.iter().map(|name| (name.as_str(), OsStr::new(name)));
    Ok(read_each(files, handed_out, |name| source.file(name)))
}

/// Reads files, each given by its name and its path.
pub(super) fn read_files(
    files: &[(String, PathBuf)],
    handed_out: &'static HandedOut,
) -> SubmissionFiles {
    let files = files.iter().map(|(name, path)| (name.as_str(), path));
    read_each(files, handed_out, |path| system::open_regular_file(path))
}

/// Reads the task files and the given files among these files, and lists the other Rust files. Each
/// file is given by its name and an argument for `open`.
fn read_each<'a, T>(
    files: impl Iterator<Item = (&'a str, T)>,
    handed_out: &'static HandedOut,
    open: impl Fn(T) -> io::Result<Option<File>>,
) -> SubmissionFiles {
    let mut contents = SubmissionFiles::default();
    for (name, file) in files {
        if let Some(TaskFile { name, .. }) = handed_out.task_file(name) {
            contents
                .task_files
                .insert(name, read_file(open(file), name));
        } else if name.ends_with(".rs") {
            let is_compared = handed_out.given_file(name).is_some();
            let bytes = is_compared.then(|| read_file(open(file), "a given file"));
            let bytes = bytes.and_then(Result::ok).unwrap_or_default();
            contents.other_files.insert(name.to_owned(), bytes);
        }
    }
    contents
}

fn read_file(
    opened: io::Result<Option<File>>,
    name: &'static str,
) -> Result<Vec<u8>, TaskFileError> {
    let io = |error: io::Error| TaskFileError::Io {
        name,
        why: error.kind().to_string(),
    };
    let Some(file) = opened.map_err(io)? else {
        return Err(TaskFileError::NotRegular(name));
    };
    let mut bytes = Vec::new();
    file.take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(io)?;
    Ok(bytes)
}

/// The task files in a folder, and the links that could hide some. Paths are relative to the
/// folder, with `/`.
#[derive(Debug, Default)]
struct Search {
    /// The paths of all task files in the searched folders. A candidate folder that is a link is
    /// listed as if it had a task file.
    files: Vec<String>,
    /// Links in place of task files or their folders, as pairs: the path of the folder in which the
    /// task files are expected, and the link.
    links: Vec<(String, String)>,
    /// Links at the top level, which may lead to folders with task files.
    linked_folders: Vec<String>,
}

/// Looks for task files in this folder and in each folder in it, in the subfolders that the assignment
/// names.
fn search(folder: &Folder, handed_out: &HandedOut) -> io::Result<Search> {
    let mut found = Search::default();
    search_candidates(folder, "", handed_out, &mut found)?;
    for name in folder.names()? {
        let Some(text) = name.to_str() else { continue };
        match folder.kind(&name)? {
            EntryKind::Folder => {
                // A folder that we may not read has nothing that could be graded.
                if let Ok(Some(top)) = folder.subfolder(&name) {
                    search_candidates(&top, text, handed_out, &mut found)?;
                }
            }
            EntryKind::Link => found.linked_folders.push(text.to_owned()),
            EntryKind::File | EntryKind::Other => {}
        }
    }
    Ok(found)
}

/// Looks for task files in a folder, whose own path is `path`, in the subfolders that the assignment
/// names.
fn search_candidates(
    folder: &Folder,
    path: &str,
    handed_out: &HandedOut,
    found: &mut Search,
) -> io::Result<()> {
    for candidate in handed_out.assignment.folders {
        let path = join(path, candidate);
        let candidate = match open_below(folder, candidate)? {
            Subfolder::Found(candidate) => candidate,
            Subfolder::Link => {
                found.files.push(join(&path, handed_out.files[0].name));
                found.links.push((path.clone(), path));
                continue;
            }
            Subfolder::Missing => continue,
        };
        for name in candidate.names()? {
            let file = name.to_str().and_then(|name| handed_out.task_file(name));
            let Some(TaskFile { name, .. }) = file else {
                continue;
            };
            found.files.push(join(&path, name));
            if candidate.kind(OsStr::new(name))? == EntryKind::Link {
                found.links.push((path.clone(), join(&path, name)));
            }
        }
    }
    Ok(())
}

/// The result of opening a path below a folder.
#[derive(Debug)]
enum Subfolder {
    Found(Folder),
    /// A component of the path is a link.
    Link,
    /// A component of the path does not exist, is not a folder, or is not readable.
    Missing,
}

/// Opens a path below a folder one component at a time, so that no link is followed. `path` uses
/// `/`.
fn open_below(folder: &Folder, path: &str) -> io::Result<Subfolder> {
    let mut opened = folder.try_clone()?;
    for part in path.split('/').filter(|part| !part.is_empty()) {
        let part = OsString::from(part);
        match opened.kind(&part) {
            Ok(EntryKind::Link) => return Ok(Subfolder::Link),
            Ok(EntryKind::Folder) => {}
            Ok(EntryKind::File | EntryKind::Other) | Err(_) => return Ok(Subfolder::Missing),
        }
        match opened.subfolder(&part) {
            Ok(Some(subfolder)) => opened = subfolder,
            Ok(None) | Err(_) => return Ok(Subfolder::Missing),
        }
    }
    Ok(Subfolder::Found(opened))
}

fn join(folder: &str, name: &str) -> String {
    match (folder, name) {
        ("", name) | (name, "") => name.to_owned(),
        (folder, name) => format!("{folder}/{name}"),
    }
}
