//! The list of mutants that are equivalent to the reference, each with the reason. It is written by
//! hand.

use std::path::Path;

use serde::Deserialize;

use crate::solutions::toml_file::{TomlFileError, read_toml};

/// The path of the list, relative to the workspace's root.
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
    /// The file cannot be read or is invalid.
    #[error(transparent)]
    Toml(#[from] TomlFileError),
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

    let File { equivalent: all } = read_toml(&root.join(PATH))?;
    for (index, EquivalentMutant { name, why }) in all.iter().enumerate() {
        let is_duplicate = all[..index].iter().any(|other| other.name == *name);
        if is_duplicate || why.trim().is_empty() {
            return Err(EquivalentsError::Entry(name.clone()));
        }
    }
    Ok(all)
}
