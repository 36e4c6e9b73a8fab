//! Reads the TOML files of solutions.

use std::path::Path;

use anyhow::{Result, anyhow};
use grader::files;
use serde::de::DeserializeOwned;

/// Reads a TOML file. If it is not TOML, or does not have the expected keys, the error says where.
pub fn read_toml<T: DeserializeOwned>(path: &Path) -> Result<T> {
    let text = files::read_to_string(path)?;
    toml::from_str(&text).map_err(|error| anyhow!("{}: {error}", path.display()))
}
