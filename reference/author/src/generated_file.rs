//! Writes generated files, or checks that they are up to date.

use std::fs;
use std::path::Path;

use anyhow::{Result, bail};
use grader::files;

/// A generated file and its contents.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneratedFile {
    /// The path relative to the workspace's root, with `/` as the separator.
    pub path: String,
    /// The complete contents of the file.
    pub contents: String,
}

impl GeneratedFile {
    /// Creates a file from its path and contents.
    pub fn new(path: impl Into<String>, contents: impl Into<String>) -> Self {
        GeneratedFile {
            path: path.into(),
            contents: contents.into(),
        }
    }
}

/// Whether to write generated files or to check them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Write the files that differ.
    Write,
    /// Change nothing, and fail if any file differs.
    Check,
}

/// Writes the files below `root`, or compares them with the files there. If any of them differ, the
/// error message says to run `command`, which writes the files.
pub fn write_or_check(
    files: &[GeneratedFile],
    root: &Path,
    mode: Mode,
    command: &str,
) -> Result<()> {
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
            bail!("out of date: {}; run `{command}`", paths.join(", "))
        }
    }
}

fn differs(file: &GeneratedFile, root: &Path) -> bool {
    // A file that cannot be read is treated as different.
    let found = fs::read(root.join(&file.path));
    !found.is_ok_and(|found| found == file.contents.as_bytes())
}

fn write(file: &GeneratedFile, root: &Path) -> Result<()> {
    let path = root.join(&file.path);
    Ok(files::write_with_parents(path, &file.contents)?)
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
            "out of date: a/one.txt, two.txt; run `make`"
        );
        assert!(!root.path().join("a").exists(), "a check changes nothing");
    }
}
