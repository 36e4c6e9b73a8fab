//! Reads a submission from a folder on disk. Links are not followed, and only regular files are
//! read.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::source_folder::{self, AmbiguousSource, CANDIDATES};
use super::{
    MAX_FILE_BYTES, SubmissionError, SubmissionFiles, TaskFileError, is_given_file, task_file_name,
};
use crate::given_files::TASK_FILES;
use crate::system;

/// Reads the task files of a folder, and the Rust files beside them.
pub(super) fn read(folder: &Path) -> Result<SubmissionFiles, SubmissionError> {
    let paths = candidate_paths(folder);
    let source = source_folder::find(paths.iter().map(String::as_str));
    let source = source.map_err(|AmbiguousSource(folders)| SubmissionError::Ambiguous {
        path: folder.to_owned(),
        folders,
    })?;
    let source = source.ok_or_else(|| SubmissionError::NoTaskFiles(folder.to_owned()))?;
    Ok(read_files(&list_files(&folder.join(source))))
}

/// Reads the files with these names and paths.
pub(super) fn read_files(files: &[(String, PathBuf)]) -> SubmissionFiles {
    let mut contents = SubmissionFiles::default();
    for (name, path) in files {
        if let Some(name) = task_file_name(name) {
            contents.task_files.insert(name, read_file(path, name));
        } else if name.ends_with(".rs") {
            let is_compared = is_given_file(name);
            let bytes = is_compared.then(|| read_file(path, "a given file"));
            let bytes = bytes.and_then(Result::ok).unwrap_or_default();
            contents.other_files.insert(name.clone(), bytes);
        }
    }
    contents
}

/// Returns the paths of all task files in folders where they may be, relative to `folder` and with
/// `/`.
fn candidate_paths(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut tops: Vec<String> = names.filter(|name| folder.join(name).is_dir()).collect();
    tops.sort();
    let below = |top: &String| CANDIDATES.map(|candidate| join(top, candidate));
    let folders = CANDIDATES.map(str::to_owned).into_iter();
    let paths = folders
        .chain(tops.iter().flat_map(below))
        .flat_map(|candidate| {
            let names = TASK_FILES.iter().map(|file| file.name);
            names.map(|name| join(&candidate, name)).collect::<Vec<_>>()
        });
    paths
        .filter(|path| folder.join(path).symlink_metadata().is_ok())
        .collect()
}

fn join(folder: &str, name: &str) -> String {
    match (folder, name) {
        ("", name) | (name, "") => name.to_owned(),
        (folder, name) => format!("{folder}/{name}"),
    }
}

/// Returns the names and paths of a folder's entries.
fn list_files(folder: &Path) -> Vec<(String, PathBuf)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let file = |entry: fs::DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        (name, entry.path())
    };
    entries.map(file).collect()
}

fn read_file(path: &Path, name: &'static str) -> Result<Vec<u8>, TaskFileError> {
    let io = |error: io::Error| TaskFileError::Io {
        name,
        why: error.kind().to_string(),
    };
    let Some(file) = system::open_regular_file(path).map_err(io)? else {
        return Err(TaskFileError::NotRegular(name));
    };
    let mut bytes = Vec::new();
    file.take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(io)?;
    Ok(bytes)
}
