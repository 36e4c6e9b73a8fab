//! Reasons for not grading a submission or one of its files.

use std::path::PathBuf;

use super::archive::ArchiveError;
use super::display_name;
use super::limit::Limit;
use crate::error::Error;
use crate::machine::files::PathError;

/// The maximum number of names in a message about a submission without task files.
const MAX_NAMES: usize = 10;

/// Reasons for not grading a task file. The tasks in such a file score nothing, but the other files
/// are graded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TaskFileError {
    /// The file doesn't exist.
    Missing,
    /// The file contains only white space.
    Empty,
    /// The path is a folder, a link or a device.
    NotRegular,
    /// The file is longer than any reasonable solution.
    TooLong,
    /// The file isn't valid UTF-8. The number is the line of the first invalid byte, counted from
    /// 1.
    NotText(usize),
    /// The system cannot read the file and gives this reason.
    Unreadable(String),
}

/// Reasons for finding no submission to grade at a path. These are usage errors.
#[derive(Debug, thiserror::Error)]
pub enum SubmissionError {
    /// The path doesn't exist.
    #[error(
        "{} does not exist{suggestion}: pass the folder that contains the task files, such as `student`",
        path.display()
    )]
    NotFound {
        /// The path.
        path: PathBuf,
        /// The suggestion if the path could be a misspelt task. Empty otherwise.
        suggestion: String,
    },
    /// The path is a device, a pipe or a socket.
    #[error("{0} is neither a folder nor a file: pass the folder that contains the task files")]
    NotFileOrFolder(PathBuf),
    /// The folder or archive contains none of the task files.
    #[error(
        "{} contains none of {files} in any of its folders; it contains {}{advice}",
        path.display(),
        listed(found)
    )]
    NoTaskFiles {
        /// The path of the folder or archive.
        path: PathBuf,
        /// The names of the task files.
        files: String,
        /// The names of the files and folders found instead.
        found: Vec<String>,
        /// The advice to give if only the files' names are wrong. Empty otherwise.
        advice: String,
    },
    /// One of the files or folders to read is a link.
    #[error(
        "{path}: {link} is a link, and links are not followed: replace it with the actual file or folder"
    )]
    Link {
        /// The path of the submission's folder.
        path: PathBuf,
        /// The path of the link itself, relative to the submission's folder.
        link: String,
    },
    /// The system cannot read the folder.
    #[error(transparent)]
    Unreadable(PathError),
    /// The machine failed to read a file or folder. Nothing is known about the submission.
    #[error("{0}; this is a problem with the machine, so try again")]
    Machine(PathError),
    /// Several copies of the task files differ, and any of them could be the right one.
    #[error(
        "{path} contains different copies of {}, in {}: keep only {} that should be graded",
        listed(files),
        places(copies),
        if files.len() == 1 { "the one" } else { "those" }
    )]
    Ambiguous {
        /// The path of the folder or archive.
        path: PathBuf,
        /// The names of the task files.
        files: Vec<String>,
        /// Two of the folders or files. An empty path stands for the top level.
        copies: Vec<String>,
    },
    /// Task files are unmodified, but changed copies of them exist.
    #[error(
        "{path} contains the unmodified starter version of {}, and modified copies in {}: keep only \
         the file that should be graded, and give it the task file's name",
        listed(starters),
        listed(copies)
    )]
    StarterBesideCopies {
        /// The path of the folder or archive.
        path: PathBuf,
        /// The names of the task files.
        starters: Vec<String>,
        /// The paths of the copies.
        copies: Vec<String>,
    },
    /// The submission exceeds a limit on reading it.
    #[error("{0} contains {1}: hand in only the task files")]
    TooMany(PathBuf, Limit),
    /// The path is a file, but not an archive that can be read.
    #[error("{path}: {why}")]
    Archive {
        /// The path of the file.
        path: PathBuf,
        /// The reason the archive is rejected.
        why: ArchiveError,
    },
}

impl TaskFileError {
    /// Returns the message about the task file with this name.
    pub fn message(&self, name: &str) -> String {
        match self {
            TaskFileError::Missing => format!("{name} is missing"),
            TaskFileError::Empty => {
                format!("{name} is empty: `cargo grade --reset {name}` restores the original file")
            }
            TaskFileError::NotRegular => format!("{name} is not a regular file"),
            TaskFileError::TooLong => format!("{name} is larger than 1 MiB"),
            TaskFileError::NotText(line) => format!(
                "{name} is not UTF-8 text: line {line} has an invalid byte. Save the file as UTF-8"
            ),
            TaskFileError::Unreadable(why) => format!("cannot read {name}: {why}"),
        }
    }
}

impl SubmissionError {
    /// Returns whether the machine is at fault, rather than the submission.
    pub fn is_machine_fault(&self) -> bool {
        matches!(
            self,
            SubmissionError::Machine(_)
                | SubmissionError::Archive {
                    why: ArchiveError::Machine(_),
                    ..
                }
        )
    }
}

impl From<SubmissionError> for Error {
    fn from(error: SubmissionError) -> Self {
        if error.is_machine_fault() {
            Error::machine(error)
        } else {
            Error::user(error)
        }
    }
}

/// Lists the first few of these names for a message.
pub fn listed(names: &[String]) -> String {
    let some = names.iter().take(MAX_NAMES).map(|name| display_name(name));
    let some = some.collect::<Vec<_>>().join(", ");
    match names.len() {
        0 => "no files".to_owned(),
        count if count > MAX_NAMES => format!("{some} and {} more", count - MAX_NAMES),
        _ => some,
    }
}

/// Lists the folders and files of [`SubmissionError::Ambiguous`] for a message.
fn places(paths: &[impl AsRef<str>]) -> String {
    let name = |path| match path {
        "" => "its top level",
        path => path,
    };
    let names = paths.iter().map(|path| name(path.as_ref()));
    names.collect::<Vec<_>>().join(" and ")
}

#[cfg(test)]
mod tests {
    use std::io::ErrorKind;

    use super::*;

    fn path_error(kind: ErrorKind) -> PathError {
        let (path, source) = ("ann".into(), kind.into());
        let action = "read";
        PathError {
            action,
            path,
            source,
        }
    }

    #[test]
    fn only_a_fault_of_the_machine_costs_no_points() {
        let archive = |why| SubmissionError::Archive {
            path: "a.zip".into(),
            why,
        };
        for (error, is_fault) in [
            (
                SubmissionError::Machine(path_error(ErrorKind::TimedOut)),
                true,
            ),
            (archive(ArchiveError::Machine("timed out".to_owned())), true),
            (
                SubmissionError::Unreadable(path_error(ErrorKind::NotFound)),
                false,
            ),
            (archive(ArchiveError::Empty), false),
            (
                SubmissionError::NotFound {
                    path: "ann".into(),
                    suggestion: String::new(),
                },
                false,
            ),
            (SubmissionError::TooMany("ann".into(), Limit::Files), false),
        ] {
            assert_eq!(error.is_machine_fault(), is_fault, "{error}");
        }
    }

    #[test]
    fn a_list_of_names_ends_with_the_number_of_others() {
        let list = |count: usize| {
            let names: Vec<String> = (1..=count).map(|n| n.to_string()).collect();
            listed(&names)
        };
        assert_eq!(list(0), "no files");
        assert_eq!(list(2), "1, 2");
        let ten = "1, 2, 3, 4, 5, 6, 7, 8, 9, 10";
        assert_eq!(list(10), ten);
        assert_eq!(list(12), format!("{ten} and 2 more"));
        assert_eq!(listed(&["a\u{7}".to_owned()]), "a\\u{7}");
    }

    #[test]
    fn the_top_of_a_submission_has_a_name() {
        let paths = [String::new(), "old".to_owned()];
        assert_eq!(places(&paths), "its top level and old");
        let error = SubmissionError::Ambiguous {
            path: "ann".into(),
            files: vec!["bvh.rs".to_owned()],
            copies: paths.into(),
        };
        let message = "ann contains different copies of bvh.rs, in its top level and old: keep \
                       only the one that should be graded";
        assert_eq!(error.to_string(), message);
    }
}
