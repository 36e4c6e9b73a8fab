//! The mutants that are equivalent to the reference, each with the reason. The list is written by
//! hand.

use std::path::Path;

use anyhow::{Result, bail};
use grader::handed_out::HandedOut;
use serde::Deserialize;

use crate::solutions::read_toml;

/// The path of the list, relative to the folder of an assignment's solutions.
pub const FILE: &str = "mutants/equivalent.toml";

/// A mutant that is expected to get full marks, because it is as correct as the reference.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EquivalentMutant {
    /// The mutant's name in the list of all mutants.
    pub name: String,
    /// Why no answer differs from the reference's, or why the contract allows those that do.
    pub why: String,
}

/// Reads an assignment's list from the workspace at `root`.
pub fn equivalent_mutants(root: &Path, handed_out: &HandedOut) -> Result<Vec<EquivalentMutant>> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        equivalent: Vec<EquivalentMutant>,
    }

    let File { equivalent: all } = read_toml(&root.join(handed_out.solutions()).join(FILE))?;
    for (index, EquivalentMutant { name, why }) in all.iter().enumerate() {
        let is_duplicate = all[..index].iter().any(|other| other.name == *name);
        if is_duplicate || why.trim().is_empty() {
            bail!("{FILE}: `{name}` must have a reason and occur only once");
        }
    }
    Ok(all)
}
