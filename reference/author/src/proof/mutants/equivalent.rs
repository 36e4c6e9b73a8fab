//! Mutants that no answer can tell from the reference, and why: `reference/mutants/equivalent.toml`,
//! written by hand.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::proof::sources::{Unreadable, read};

/// Where they stand, from the workspace's root.
pub const PATH: &str = "reference/mutants/equivalent.toml";

/// A mutant that earns all points, as it should.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Equivalent {
    /// The mutant's, as in the list of all.
    pub name: String,
    /// Why no answer can differ, or which promise is not made of the answers that do.
    pub why: String,
}

/// They can not be used.
#[derive(Debug, thiserror::Error)]
pub enum BadEquivalents {
    /// The file can not be read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
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
pub fn equivalents(root: &Path) -> Result<Vec<Equivalent>, BadEquivalents> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        equivalent: Vec<Equivalent>,
    }

    let path = root.join(PATH);
    let file: Result<File, _> = toml::from_str(&read(&path)?);
    let all = match file {
        Ok(file) => file.equivalent,
        Err(source) => return Err(BadEquivalents::Toml { path, source }),
    };
    for (place, Equivalent { name, why }) in all.iter().enumerate() {
        let known = all[..place].iter().any(|other| other.name == *name);
        if known || why.trim().is_empty() {
            return Err(BadEquivalents::Entry(name.clone()));
        }
    }
    Ok(all)
}
