//! The lists of changes to the reference that are equivalent to it, each with the reason. They are
//! written by hand: `reference/mutants/equivalent.toml` for the mutants of cargo-mutants, and
//! `reference/mutants/systematic.toml` for systematic mistakes.

use std::path::Path;

use serde::Deserialize;

use crate::solutions::toml_file::{TomlFileError, read_toml};

/// The list of mutants, relative to the workspace's root.
pub const OF_MUTANTS: &str = "reference/mutants/equivalent.toml";
/// The list of systematic mistakes, relative to the workspace's root.
pub const OF_SYSTEMATIC_MISTAKES: &str = "reference/mutants/systematic.toml";

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
    #[error("{path}: `{name}` must have a reason and occur only once")]
    Entry {
        /// The list.
        path: &'static str,
        /// The entry.
        name: String,
    },
}

/// Reads a list of the workspace at `root`.
pub fn equivalent_mutants(
    root: &Path,
    path: &'static str,
) -> Result<Vec<EquivalentMutant>, EquivalentsError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        equivalent: Vec<EquivalentMutant>,
    }

    let File { equivalent: all } = read_toml(&root.join(path))?;
    for (index, EquivalentMutant { name, why }) in all.iter().enumerate() {
        let is_duplicate = all[..index].iter().any(|other| other.name == *name);
        if is_duplicate || why.trim().is_empty() {
            return Err(EquivalentsError::Entry {
                path,
                name: name.clone(),
            });
        }
    }
    Ok(all)
}
