//! Variants: known correct solutions that differ from the reference. A variant's files are in the
//! folder `variants/STEM` of an assignment's solutions. Together with the given code in the
//! reference's `STEM.rs`, they replace that file.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow};
use grader::handed_out::HandedOut;
use judging::assignment::{Assignment, Task};
use projection::replacements;
use serde::Deserialize;

use crate::solutions::read_toml;
use crate::solutions::solution::{Expected, Solution};
use crate::solutions::sources::Sources;

/// A known correct solution.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// The stem of the replaced file (or of one of them), a dot and a name, such as
    /// `sphere.stable_quadratic`.
    pub id: String,
    /// A description of its method.
    pub title: String,
    /// A publication that describes the method.
    #[serde(default)]
    pub source: Option<String>,
    /// The only items where it may lose points. For a builder that doesn't use the surface area
    /// heuristic, they are the items about tree cost.
    #[serde(default)]
    pub may_lose: Vec<String>,
    /// The paths of its parts, relative to the folder of variants and without `.rs`. Each path
    /// begins with the stem of the file that the part replaces. The list is empty if the variant is
    /// a single file; that file is named after the variant's id.
    #[serde(default)]
    pub parts: Vec<String>,
    /// The crates that the variant uses although submissions may not use them.
    #[serde(default)]
    pub crates: Vec<String>,
}

/// Returns the folder of an assignment's variants in the workspace at `root`.
pub fn folder(root: &Path, handed_out: &HandedOut) -> PathBuf {
    root.join(handed_out.solutions()).join("variants")
}

/// Reads the list of an assignment's variants from the workspace at `root`.
pub fn variants(root: &Path, handed_out: &HandedOut) -> Result<Vec<Variant>> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        variant: Vec<Variant>,
    }

    let file: File = read_toml(&folder(root, handed_out).join("variants.toml"))?;
    Ok(file.variant)
}

impl Variant {
    /// Returns the tasks of the assignment that the variant's files solve.
    fn tasks(&self, assignment: &Assignment) -> Vec<Task> {
        let parts = self.parts.iter().filter_map(|part| part.split_once('/'));
        let stems = parts.map(|(stem, _)| stem).chain(self.id.split('.').next());
        let mut files: Vec<String> = stems.map(|stem| format!("{stem}.rs")).collect();
        files.sort();
        files.dedup();
        let tasks = files.iter().flat_map(|file| assignment.tasks_in(file));
        tasks.collect()
    }

    /// Returns the reference with some task files replaced by the variant's files, which are
    /// completed with the given code.
    pub fn solution(&self, reference: &Sources, root: &Path) -> Result<Solution> {
        let mut sources = reference.clone();
        let folder = folder(root, reference.handed_out());
        for replacement in replacements(&folder, &self.id, &self.parts)? {
            let file = format!("{}.rs", replacement.stem);
            let text = replacement
                .complete(reference.text(&file).unwrap_or_default())
                .map_err(|error| anyhow!("the variant {}: {error}", self.id))?;
            sources = sources.with_file(&file, text);
        }
        Ok(Solution {
            id: self.id.clone(),
            title: self.title.clone(),
            sources: sources.with_crates(&self.crates),
            expected: Expected {
                tasks: self.tasks(reference.handed_out().assignment),
                may_lose: self.may_lose.clone(),
                ..Expected::default()
            },
        })
    }
}
