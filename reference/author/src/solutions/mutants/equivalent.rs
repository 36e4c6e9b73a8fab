//! The list of mutants that are equivalent to the reference, each with the reason. It is written by
//! hand: `reference/mutants/equivalent.toml`.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::text_file::{ReadError, read};

/// The file of the list, relative to the workspace's root.
pub const PATH: &str = "reference/mutants/equivalent.toml";

/// A mutant that is expected to get full marks, because it is as correct as the reference.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EquivalentMutant {
    /// The mutant's name in the list of all mutants.
    pub name: String,
    /// The reason why no answer differs, or why the contract allows the answers that differ.
    pub why: String,
}

/// The reason why the list cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum EquivalentsError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file is invalid.
    #[error("{}: {source}", path.display())]
    Toml {
        /// The path of the file.
        path: PathBuf,
        /// The parse error, with its line and column.
        source: toml::de::Error,
    },
    /// An entry has no reason, or a name occurs twice.
    #[error("{PATH}: `{0}` must have a reason and occur only once")]
    Entry(String),
}

/// Reads the list of the workspace at `root`.
pub fn equivalent_mutants(root: &Path) -> Result<Vec<EquivalentMutant>, EquivalentsError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        equivalent: Vec<EquivalentMutant>,
    }

    let path = root.join(PATH);
    let file: Result<File, _> = toml::from_str(&read(&path)?);
    let all = match file {
        Ok(file) => file.equivalent,
        Err(source) => return Err(EquivalentsError::Toml { path, source }),
    };
    for (index, EquivalentMutant { name, why }) in all.iter().enumerate() {
        let is_duplicate = all[..index].iter().any(|other| other.name == *name);
        if is_duplicate || why.trim().is_empty() {
            return Err(EquivalentsError::Entry(name.clone()));
        }
    }
    Ok(all)
}
