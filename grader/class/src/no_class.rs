//! Why there is no class to be graded.

use std::io;
use std::path::PathBuf;

use grader::submission::Refused;

use crate::layout::BadMetadata;

/// There is no class to be found.
#[derive(Debug, thiserror::Error)]
pub enum NoClass {
    /// There is nothing at this place.
    #[error("there is no {0}: name the folder or archive that the platform gave you")]
    Nowhere(PathBuf),
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
    Refused {
        /// Which.
        path: PathBuf,
        /// What is wrong with it.
        why: Refused,
    },
    /// Gradescope's list is not as it should be.
    #[error(transparent)]
    Metadata(#[from] BadMetadata),
    /// Nobody is in it.
    #[error(
        "{0} holds no submissions: name the folder of a class; one alone is graded by `cargo grade`"
    )]
    Nobody(PathBuf),
}
