//! Files that are made, not written: the only place that touches them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A file and what it must hold.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneratedFile {
    /// Relative to the workspace's root, with `/`.
    pub path: String,
    /// All of its text.
    pub contents: String,
}

impl GeneratedFile {
    /// A file from its parts.
    pub fn new(path: impl Into<String>, contents: impl Into<String>) -> Self {
        GeneratedFile {
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
pub enum GeneratedFileError {
    /// What stands there is something else, or nothing.
    #[error("not as generated: {}\nfix it with `{command}`", paths.join(", "))]
    Differs {
        /// Every file that differs or is missing.
        paths: Vec<String>,
        /// The command that writes them.
        command: String,
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
pub fn write_or_check(
    files: &[GeneratedFile],
    root: &Path,
    mode: Mode,
    mend: &str,
) -> Result<(), GeneratedFileError> {
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
            Err(GeneratedFileError::Differs {
                paths,
                command: mend,
            })
        }
    }
}

fn differs(file: &GeneratedFile, root: &Path) -> bool {
    // A file that can not be read is not as it must be either.
    let found = fs::read(root.join(&file.path));
    !found.is_ok_and(|found| found == file.contents.as_bytes())
}

fn write(file: &GeneratedFile, root: &Path) -> Result<(), GeneratedFileError> {
    let path = root.join(&file.path);
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder
        .and_then(|()| fs::write(&path, &file.contents))
        .map_err(|source| GeneratedFileError::Unwritable { path, source })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files() -> Vec<GeneratedFile> {
        vec![
            GeneratedFile::new("a/one.txt", "1\n"),
            GeneratedFile::new("two.txt", "2\n"),
        ]
    }

    #[test]
    fn written_files_pass_the_check() {
        let root = tempfile::tempdir().unwrap();
        write_or_check(&files(), root.path(), Mode::Write, "make").unwrap();
        write_or_check(&files(), root.path(), Mode::Check, "make").unwrap();
    }

    #[test]
    fn reports_each_differing_or_missing_file_and_the_command_that_fixes_it() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("two.txt"), "3\n").unwrap();
        let error = write_or_check(&files(), root.path(), Mode::Check, "make").unwrap_err();
        assert_eq!(
            error.to_string(),
            "not as generated: a/one.txt, two.txt\nfix it with `make`"
        );
        assert!(!root.path().join("a").exists(), "a check changes nothing");
    }
}
