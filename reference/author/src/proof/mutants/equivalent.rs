//! Mutants that no answer can tell from the reference, and why: `reference/mutants/equivalent.toml`,
//! written by hand.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::proof::sources::{ReadError, read};

/// Where they stand, from the workspace's root.
pub const PATH: &str = "reference/mutants/equivalent.toml";

/// A mutant that earns all points, as it should.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EquivalentMutant {
    /// The mutant's, as in the list of all.
    pub name: String,
    /// Why no answer can differ, or which promise is not made of the answers that do.
    pub why: String,
}

/// They can not be used.
#[derive(Debug, thiserror::Error)]
pub enum EquivalentsError {
    /// The file can not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// It is not as it has to be.
    #[error("{}: {source}", path.display())]
    Toml {
        /// The file.
        path: PathBuf,
        /// Line, column, and what is wrong there.
        source: toml::de::Error,
    },
    /// A name stands there without a reason, or twice.
    #[error("{PATH}: `{0}` has no reason, or stands twice")]
    Entry(String),
}

/// Those of the workspace at `root`.
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
    for (place, EquivalentMutant { name, why }) in all.iter().enumerate() {
        let known = all[..place].iter().any(|other| other.name == *name);
        if known || why.trim().is_empty() {
            return Err(EquivalentsError::Entry(name.clone()));
        }
    }
    Ok(all)
}
