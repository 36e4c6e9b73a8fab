//! Why there is no class to be graded.

use std::io;
use std::path::PathBuf;

use grader::submission::ArchiveError;

use crate::layout::MetadataError;

/// There is no class to be found.
#[derive(Debug, thiserror::Error)]
pub enum ClassInputError {
    /// There is nothing at this place.
    #[error("there is no {0}: name the folder or archive that the platform gave you")]
    NotFound(PathBuf),
    /// The system does not let us.
    #[error("can not read {path}: {source}")]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// The archive is not one that is read.
    #[error("{path}: {why}; or unpack it yourself, and name the folder")]
    Archive {
        /// Which.
        path: PathBuf,
        /// What is wrong with it.
        why: ArchiveError,
    },
    /// Gradescope's list is not as it should be.
    #[error(transparent)]
    Metadata(#[from] MetadataError),
    /// Nobody is in it.
    #[error(
        "{0} holds no submissions: name the folder of a class; one alone is graded by `cargo grade`"
    )]
    NoSubmissions(PathBuf),
}
