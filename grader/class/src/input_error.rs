//! Errors in the input folder or archive.

use std::path::PathBuf;

use grader::files::PathError;
use grader::submission::ArchiveError;
use judging::sanitize::sanitize_line;

use crate::layout::MetadataError;

/// The maximum length of a reason that has names, in characters.
const MAX_CHARS: usize = 600;

/// An error that prevents the input from being read as a class.
#[derive(Debug, thiserror::Error)]
pub enum ClassInputError {
    /// The path does not exist.
    #[error("{0} does not exist: pass the folder or archive that you downloaded from the platform")]
    NotFound(PathBuf),
    /// A file or folder cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// The archive cannot be read.
    #[error("{path}: {why}; alternatively, unpack it yourself and pass the path of the folder")]
    Archive {
        /// The archive's path.
        path: PathBuf,
        /// The reason why the archive cannot be read.
        why: ArchiveError,
    },
    /// Gradescope's metadata file is invalid.
    #[error(transparent)]
    Metadata(#[from] MetadataError),
    /// Most entries seem to be of several people.
    #[error(
        "{path} cannot be read as a class: {}{}",
        sanitize_line(why, MAX_CHARS),
        if path.is_dir() { "" } else { "; unpack the archive first" }
    )]
    SeveralPeople {
        /// The path of the input.
        path: PathBuf,
        /// The reason for the first entry, and what to do.
        why: String,
    },
    /// The input contains no submissions.
    #[error(
        "{0} contains no submissions: pass the folder of a class; to grade a single submission, \
         use `cargo grade`"
    )]
    NoSubmissions(PathBuf),
}
