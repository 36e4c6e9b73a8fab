//! The reasons why a task cannot start afresh.

use std::path::PathBuf;

use crate::files::PathError;
use crate::handed_out::FreshMethodError;
use crate::submission::places;
use crate::workspace::WorkspaceError;

/// The reason why a task cannot start afresh.
#[derive(Debug, thiserror::Error)]
pub enum ResetError {
    /// The path is an archive or does not exist.
    #[error(
        "{0} is not a folder: --reset changes the files in a folder, such as `student`; unpack an \
         archive first"
    )]
    NotAFolder(PathBuf),
    /// A file or folder is a link, which could lead to someone else's files.
    #[error("{0} is a link, and links are not followed: replace it with the actual file or folder")]
    Link(PathBuf),
    /// The path of a file is a folder or a device.
    #[error("{0} is not a regular file: move it away, and try again")]
    NotRegular(PathBuf),
    /// The folder has none of the task files.
    #[error("{folder} has none of {files}: name the folder with the task files, such as `student`")]
    NoTaskFiles {
        /// The submission's folder.
        folder: PathBuf,
        /// The names of the task files.
        files: String,
    },
    /// Several folders have task files.
    #[error(
        "{folder} has task files in {}: name the one that you mean",
        places(folders)
    )]
    SeveralFolders {
        /// The submission's folder.
        folder: PathBuf,
        /// The paths below it that have task files.
        folders: Vec<String>,
    },
    /// A file in which one method is to be replaced does not exist.
    #[error("{0} is missing: `cargo grade --reset {0}` writes the file as it was handed out")]
    Missing(&'static str),
    /// The file is not UTF-8.
    #[error(
        "{0} is not UTF-8 text: `cargo grade --reset {0}` replaces the whole file, and keeps a copy"
    )]
    NotText(&'static str),
    /// The method is not found.
    #[error(
        "{0}; `cargo grade --reset {file}` replaces the whole file, and keeps a copy",
        file = .0.file
    )]
    Method(#[from] FreshMethodError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] PathError),
    /// The workspace cannot be found.
    #[error(transparent)]
    Workspace(#[from] WorkspaceError),
}

impl ResetError {
    /// Returns 2 for errors that the user can fix, and 3 for errors of the grader or the machine.
    pub fn exit_code(&self) -> u8 {
        match self {
            ResetError::File(_) | ResetError::Workspace(_) => 3,
            ResetError::NotAFolder(_)
            | ResetError::Link(_)
            | ResetError::NotRegular(_)
            | ResetError::NoTaskFiles { .. }
            | ResetError::SeveralFolders { .. }
            | ResetError::Missing(_)
            | ResetError::NotText(_)
            | ResetError::Method(_) => 2,
        }
    }
}
