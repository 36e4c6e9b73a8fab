//! Reads the TOML files of solutions.

use std::path::{Path, PathBuf};

use grader::files::{self, PathError};
use serde::de::DeserializeOwned;

/// The reason why a TOML file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TomlFileError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// The file is not TOML, or does not have the expected keys.
    #[error("{path}: {source}")]
    Invalid {
        /// The path of the file.
        path: PathBuf,
        /// The parse error, with its line and column.
        source: toml::de::Error,
    },
}

/// Reads a TOML file.
pub fn read_toml<T: DeserializeOwned>(path: &Path) -> Result<T, TomlFileError> {
    let text = files::read_to_string(path)?;
    toml::from_str(&text).map_err(|source| TomlFileError::Invalid {
        path: path.to_owned(),
        source,
    })
}
