//! From files on disk. Links are not followed, and what is no regular file is not opened.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::place::{self, PLACES, Several};
use super::{Contents, LONGEST_FILE, NoSubmission, Unreadable, is_given, one_of_five};
use crate::given::TASK_FILES;
use crate::system;

/// What lies where this folder holds the five files.
pub(super) fn read(folder: &Path) -> Result<Contents, NoSubmission> {
    let paths = candidates(folder);
    let source = place::source(paths.iter().map(String::as_str));
    let source = source.map_err(|Several(folders)| NoSubmission::Several {
        path: folder.to_owned(),
        folders,
    })?;
    let source = source.ok_or_else(|| NoSubmission::NoneOfFive(folder.to_owned()))?;
    Ok(read_files(&files(&folder.join(source))))
}

/// What these files are, by the names that they go by.
pub(super) fn read_files(files: &[(String, PathBuf)]) -> Contents {
    let mut contents = Contents::default();
    for (name, path) in files {
        if let Some(name) = one_of_five(name) {
            contents.five.insert(name, read_file(path, name));
        } else if name.ends_with(".rs") {
            let is_compared = is_given(name);
            let bytes = is_compared.then(|| read_file(path, "a given file"));
            let bytes = bytes.and_then(Result::ok).unwrap_or_default();
            contents.beside.insert(name.clone(), bytes);
        }
    }
    contents
}

/// All places of one of the five files that count, from this folder, with `/`.
fn candidates(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut tops: Vec<String> = names.filter(|name| folder.join(name).is_dir()).collect();
    tops.sort();
    let below = |top: &String| PLACES.map(|place| joined(top, place));
    let places = PLACES.map(str::to_owned).into_iter();
    let paths = places.chain(tops.iter().flat_map(below)).flat_map(|place| {
        let names = TASK_FILES.iter().map(|file| file.name);
        names.map(|name| joined(&place, name)).collect::<Vec<_>>()
    });
    paths
        .filter(|path| folder.join(path).symlink_metadata().is_ok())
        .collect()
}

fn joined(folder: &str, name: &str) -> String {
    match (folder, name) {
        ("", name) | (name, "") => name.to_owned(),
        (folder, name) => format!("{folder}/{name}"),
    }
}

/// The names in a folder.
fn files(folder: &Path) -> Vec<(String, PathBuf)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let file = |entry: fs::DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        (name, entry.path())
    };
    entries.map(file).collect()
}

fn read_file(path: &Path, name: &'static str) -> Result<Vec<u8>, Unreadable> {
    let io = |error: io::Error| Unreadable::Io {
        name,
        why: error.kind().to_string(),
    };
    let Some(file) = system::open_file(path).map_err(io)? else {
        return Err(Unreadable::NotAFile(name));
    };
    let mut bytes = Vec::new();
    file.take(LONGEST_FILE + 1)
        .read_to_end(&mut bytes)
        .map_err(io)?;
    Ok(bytes)
}
