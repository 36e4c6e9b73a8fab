//! Files that are made, not written: the only place that touches them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A file and what it must hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Generated {
    /// Relative to the workspace's root, with `/`.
    pub path: String,
    /// All of its text.
    pub contents: String,
}

impl Generated {
    /// A file from its parts.
    pub fn new(path: impl Into<String>, contents: impl Into<String>) -> Self {
        Generated {
            path: path.into(),
            contents: contents.into(),
        }
    }
}

/// What to do with generated files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Make them so.
    Write,
    /// Change nothing, and fail if they are not so.
    Check,
}

/// Why the files are not as they must be.
#[derive(Debug, thiserror::Error)]
pub enum GeneratedError {
    /// What stands there is something else, or nothing.
    #[error("not as generated: {}\nmend it with `{mend}`", paths.join(", "))]
    Differs {
        /// Every file that differs or is missing.
        paths: Vec<String>,
        /// The command that writes them.
        mend: String,
    },
    /// A file can not be written.
    #[error("can not write {}: {source}", path.display())]
    Unwritable {
        /// The file, or its folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// Writes the files below `root`, or compares them with what stands there. `mend` is the command
/// that writes them, for the message.
pub fn deliver(
    files: &[Generated],
    root: &Path,
    mode: Mode,
    mend: &str,
) -> Result<(), GeneratedError> {
    match mode {
        Mode::Write => files
            .iter()
            .filter(|file| differs(file, root))
            .try_for_each(|file| write(file, root)),
        Mode::Check => {
            let wrong = files.iter().filter(|file| differs(file, root));
            let paths: Vec<String> = wrong.map(|file| file.path.clone()).collect();
            if paths.is_empty() {
                return Ok(());
            }
            let mend = mend.to_owned();
            Err(GeneratedError::Differs { paths, mend })
        }
    }
}

fn differs(file: &Generated, root: &Path) -> bool {
    // A file that can not be read is not as it must be either.
    let found = fs::read(root.join(&file.path));
    !found.is_ok_and(|found| found == file.contents.as_bytes())
}

fn write(file: &Generated, root: &Path) -> Result<(), GeneratedError> {
    let path = root.join(&file.path);
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder
        .and_then(|()| fs::write(&path, &file.contents))
        .map_err(|source| GeneratedError::Unwritable { path, source })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files() -> Vec<Generated> {
        vec![
            Generated::new("a/one.txt", "1\n"),
            Generated::new("two.txt", "2\n"),
        ]
    }

    #[test]
    fn what_was_written_passes_the_check() {
        let root = tempfile::tempdir().unwrap();
        deliver(&files(), root.path(), Mode::Write, "make").unwrap();
        deliver(&files(), root.path(), Mode::Check, "make").unwrap();
    }

    #[test]
    fn each_file_that_differs_or_is_missing_is_named_with_the_mend() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("two.txt"), "3\n").unwrap();
        let error = deliver(&files(), root.path(), Mode::Check, "make").unwrap_err();
        assert_eq!(
            error.to_string(),
            "not as generated: a/one.txt, two.txt\nmend it with `make`"
        );
        assert!(!root.path().join("a").exists(), "a check changes nothing");
    }
}
