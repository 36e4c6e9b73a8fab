//! Reads and writes files, with errors that name the path.
//!
//! The crate `fs-err` isn't used, because it returns `io::Error`, so code that returns an error
//! without a path would still compile where an error with a path is expected. It also cannot name
//! the path of a temporary file or of a program to run.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::machine::disk::{self, Operation};

/// The error returned when a file, a folder or a program cannot be used.
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
    /// Adds the path to the error, whose message begins with "cannot", the words in `action` and
    /// the path.
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
    /// Returns the error with different words between "cannot" and the path.
    pub fn of_action(self, action: &'static str) -> Self {
        PathError { action, ..self }
    }

    /// Returns the system's message in the style of other messages: in lower case, without an error
    /// number, and without the random name that the crate `tempfile` adds.
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
            // Keep the capital in "I/O error".
            (Some(first), Some('a'..='z' | ' ')) => first
                .to_lowercase()
                .chain(message.chars().skip(1))
                .collect(),
            _ => message.to_owned(),
        }
    }
}

/// Returns whether a read error is caused by the file itself: the file is gone, or its permissions
/// don't allow it to be read. Other errors, such as those from a network drive, are the machine's
/// fault and must not cost a submission any points.
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

/// Calls the installed disk and then performs an operation on a file or a folder.
fn with_disk<T>(operation: Operation, act: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
    disk::before(operation)?;
    act()
}

/// Reads a file.
pub fn read(path: impl AsRef<Path>) -> Result<Vec<u8>, PathError> {
    let path = path.as_ref();
    with_disk(Operation::Read(path), || fs::read(path)).at("read", path)
}

/// Reads a text file.
pub fn read_to_string(path: impl AsRef<Path>) -> Result<String, PathError> {
    read_text(path.as_ref()).at("read", path)
}

/// Reads a text file. Returns `None` if it doesn't exist.
pub fn read_if_exists(path: impl AsRef<Path>) -> Result<Option<String>, PathError> {
    match read_text(path.as_ref()) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        read => read.at("read", path).map(Some),
    }
}

/// Opens a file for reading.
pub fn open(path: impl AsRef<Path>) -> Result<File, PathError> {
    let path = path.as_ref();
    with_disk(Operation::Read(path), || File::open(path)).at("read", path)
}

fn read_text(path: &Path) -> io::Result<String> {
    with_disk(Operation::Read(path), || fs::read_to_string(path))
}

/// Returns the paths of a folder's entries, sorted.
pub fn read_dir(folder: impl AsRef<Path>) -> Result<Vec<PathBuf>, PathError> {
    let folder = folder.as_ref();
    let listed = with_disk(Operation::List(folder), || {
        let entries = fs::read_dir(folder)?;
        entries.map(|entry| Ok(entry?.path())).collect()
    });
    let mut paths: Vec<PathBuf> = listed.at("read", folder)?;
    paths.sort();
    Ok(paths)
}

/// Writes a file into an existing folder.
pub fn write(path: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> Result<(), PathError> {
    let (path, contents) = (path.as_ref(), contents.as_ref());
    let operation = Operation::Write(path, contents);
    with_disk(operation, || fs::write(path, contents)).at("write", path)
}

/// Writes a file. Creates its folder if it doesn't exist.
pub fn write_with_parents(
    path: impl AsRef<Path>,
    contents: impl AsRef<[u8]>,
) -> Result<(), PathError> {
    path.as_ref().parent().map_or(Ok(()), create_dir_all)?;
    write(path, contents)
}

/// Copies a file and its permissions.
pub fn copy(from: impl AsRef<Path>, to: impl AsRef<Path>) -> Result<(), PathError> {
    // The error of `fs::copy` doesn't say which of the two paths is at fault.
    File::open(&from).at("read", &from)?;
    fs::copy(from, &to).map(drop).at("write", to)
}

/// Creates a folder and its parents if they don't exist.
pub fn create_dir_all(folder: impl AsRef<Path>) -> Result<(), PathError> {
    let folder = folder.as_ref();
    let operation = Operation::CreateFolder(folder);
    with_disk(operation, || fs::create_dir_all(folder)).at("create", folder)
}

/// Removes a file if it exists.
pub fn remove_if_exists(path: impl AsRef<Path>) -> Result<(), PathError> {
    let path = path.as_ref();
    match with_disk(Operation::Remove(path), || fs::remove_file(path)) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        removed => removed.at("remove", path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(source: &str) -> String {
        let failed: io::Result<()> = Err(io::Error::other(source));
        let error = failed.at("write", "out/score.json").unwrap_err();
        let message = error.to_string();
        let reason = message.strip_prefix("cannot write out/score.json: ");
        reason.expect("it names the action and the path").to_owned()
    }

    #[test]
    fn names_the_action_and_the_path() {
        let error = read_to_string("nowhere/scene.json").unwrap_err();
        let message = error.to_string();
        assert!(
            message.starts_with("cannot read nowhere/scene.json: "),
            "{message}"
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
        let mount = "cannot mount /x (os error 1): use another level";
        for (system, shown) in [
            (
                "No space left on device (os error 28)",
                "no space left on device",
            ),
            (
                "Permission denied (os error 13) at path \"/out/.tmpZ5\"",
                "permission denied",
            ),
            ("I/O error (os error 5)", "I/O error"),
            // Our own messages are unchanged.
            ("Cargo.toml is missing", "Cargo.toml is missing"),
            (mount, mount),
        ] {
            assert_eq!(message(system), shown);
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
