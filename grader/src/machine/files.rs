//! Reads and writes files, with errors that name the path.
//!
//! Not the crate `fs-err`: it returns `io::Error`, so that an error without a path still compiles
//! where one is expected, and it cannot name the path of a temporary file or of a program to run.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::machine::disk::{self, Operation};

/// The error if a file, a folder or a program cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("cannot {action} {path}: {}", self.reason())]
pub struct PathError {
    /// The words between "cannot" and the path, such as "read" or "read the exam".
    pub action: &'static str,
    /// The path of the file, folder or program.
    pub path: PathBuf,
    /// The system's error.
    pub source: io::Error,
}

/// Adds a path to the error of a system call.
pub trait AtPath<T> {
    /// Adds the path, and the words between "cannot" and the path.
    fn at(self, action: &'static str, path: impl AsRef<Path>) -> Result<T, PathError>;
}

impl<T> AtPath<T> for io::Result<T> {
    fn at(self, action: &'static str, path: impl AsRef<Path>) -> Result<T, PathError> {
        self.map_err(|source| PathError {
            action,
            path: path.as_ref().to_owned(),
            source,
        })
    }
}

impl PathError {
    /// Returns the system's message in the style of other messages: it starts in lower case and has
    /// no number. It also lacks the random name that the crate `tempfile` adds to it.
    pub fn reason(&self) -> String {
        let text = self.source.to_string();
        let Some((message, after)) = text.split_once(" (os error ") else {
            return text;
        };
        let after = after.trim_start_matches(|c: char| c == '-' || c.is_ascii_digit());
        if after != ")" && !after.starts_with(") at path ") {
            return text;
        }
        let mut letters = message.chars();
        match (letters.next(), letters.next()) {
            // Not in "I/O error".
            (Some(first), Some('a'..='z' | ' ')) => first
                .to_lowercase()
                .chain(message.chars().skip(1))
                .collect(),
            _ => message.to_owned(),
        }
    }
}

/// Returns whether an error from reading says something about the file: it is gone, or its permissions
/// deny reading. Other errors, such as those of a network drive, are the machine's, and must not cost
/// a submission points.
pub fn is_about_file(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::NotFound
            | ErrorKind::PermissionDenied
            | ErrorKind::NotADirectory
            | ErrorKind::IsADirectory
            | ErrorKind::InvalidInput
            | ErrorKind::InvalidData
            | ErrorKind::UnexpectedEof
    )
}

/// Reads a file.
pub fn read(path: impl AsRef<Path>) -> Result<Vec<u8>, PathError> {
    read_file(path.as_ref()).at("read", path)
}

/// Reads a text file.
pub fn read_to_string(path: impl AsRef<Path>) -> Result<String, PathError> {
    read_text(path.as_ref()).at("read", path)
}

/// Reads a text file, or returns `None` if it does not exist.
pub fn read_if_exists(path: impl AsRef<Path>) -> Result<Option<String>, PathError> {
    match read_text(path.as_ref()) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        read => read.at("read", path).map(Some),
    }
}

/// Opens a file for reading.
pub fn open(path: impl AsRef<Path>) -> Result<File, PathError> {
    let path = path.as_ref();
    let opened = disk::before(Operation::Read(path)).and_then(|()| File::open(path));
    opened.at("read", path)
}

fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    disk::before(Operation::Read(path))?;
    fs::read(path)
}

fn read_text(path: &Path) -> io::Result<String> {
    disk::before(Operation::Read(path))?;
    fs::read_to_string(path)
}

/// Returns the paths of a folder's entries, sorted.
pub fn read_dir(folder: impl AsRef<Path>) -> Result<Vec<PathBuf>, PathError> {
    let list = || {
        disk::before(Operation::List(folder.as_ref()))?;
        let entries = fs::read_dir(&folder)?;
        entries.map(|entry| Ok(entry?.path())).collect()
    };
    let listed: io::Result<Vec<PathBuf>> = list();
    let mut paths = listed.at("read", &folder)?;
    paths.sort();
    Ok(paths)
}

/// Writes a file into an existing folder.
pub fn write(path: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> Result<(), PathError> {
    let write = |path: &Path, contents: &[u8]| {
        disk::before(Operation::Write(path, contents))?;
        fs::write(path, contents)
    };
    write(path.as_ref(), contents.as_ref()).at("write", path)
}

/// Writes a file, and creates its folder if it does not exist.
pub fn write_with_parents(
    path: impl AsRef<Path>,
    contents: impl AsRef<[u8]>,
) -> Result<(), PathError> {
    path.as_ref().parent().map_or(Ok(()), create_dir_all)?;
    write(path, contents)
}

/// Copies a file with its permissions.
pub fn copy(from: impl AsRef<Path>, to: impl AsRef<Path>) -> Result<(), PathError> {
    // The error of `fs::copy` does not say which of the two paths is at fault.
    File::open(&from).at("read", &from)?;
    fs::copy(from, &to).map(drop).at("write", to)
}

/// Creates a folder, and those around it, if they do not exist.
pub fn create_dir_all(folder: impl AsRef<Path>) -> Result<(), PathError> {
    let create = |folder: &Path| {
        disk::before(Operation::CreateFolder(folder))?;
        fs::create_dir_all(folder)
    };
    create(folder.as_ref()).at("create", folder)
}

/// Removes a file if it exists.
pub fn remove_if_exists(path: impl AsRef<Path>) -> Result<(), PathError> {
    let remove = |path: &Path| {
        disk::before(Operation::Remove(path))?;
        fs::remove_file(path)
    };
    match remove(path.as_ref()) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        removed => removed.at("remove", path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(source: &str) -> String {
        let failed: io::Result<()> = Err(io::Error::other(source));
        failed
            .at("write", "out/score.json")
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn names_the_action_and_the_path() {
        let error = read_to_string("nowhere/scene.json").unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("cannot read nowhere/scene.json: "),
            "{error}"
        );
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        write(&file, "").unwrap();
        let below = file.join("below.txt");
        let error = write_with_parents(&below, "").unwrap_err();
        assert_eq!((error.action, error.path), ("create", file));
    }

    #[test]
    fn messages_are_in_lower_case_without_numbers_and_names_of_temporary_files() {
        assert_eq!(
            message("No space left on device (os error 28)"),
            "cannot write out/score.json: no space left on device"
        );
        assert_eq!(
            message("Permission denied (os error 13) at path \"/out/.tmpZ5\""),
            "cannot write out/score.json: permission denied"
        );
        assert_eq!(
            message("I/O error (os error 5)"),
            "cannot write out/score.json: I/O error"
        );
    }

    #[test]
    fn messages_of_our_own_are_unchanged() {
        for own in [
            "Cargo.toml is missing",
            "cannot mount /x (os error 1): use another level",
        ] {
            assert_eq!(message(own), format!("cannot write out/score.json: {own}"));
        }
    }

    #[test]
    fn a_missing_file_is_no_error_where_that_is_expected() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("score.json");
        remove_if_exists(&path).unwrap();
        assert_eq!(read_if_exists(&path).unwrap(), None);
        write(&path, "{}").unwrap();
        assert_eq!(read_if_exists(&path).unwrap().as_deref(), Some("{}"));
        remove_if_exists(&path).unwrap();
        assert!(read_dir(folder.path()).unwrap().is_empty());
        assert!(read_if_exists(folder.path()).is_err(), "a folder");
    }
}
