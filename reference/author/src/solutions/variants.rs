//! Variants: known correct solutions that differ from the reference. With the given code of the
//! reference's `STEM.rs`, each file `reference/variants/STEM/NAME.rs` replaces that file.

use std::path::{Path, PathBuf};

use grader::files::{self, PathError};
use judging::assignment::{Assignment, Task};
use projection::{GivenCodeError, given_code};
use serde::Deserialize;

use crate::solutions::sources::Sources;
use crate::solutions::toml_file::{TomlFileError, read_toml};

/// The folder of the variants.
const FOLDER: &str = "reference/variants";

/// A known correct solution.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// The stem of the file that it replaces, a dot, and a name, such as `sphere.stable_quadratic`.
    pub id: String,
    /// A description of its method.
    pub title: String,
    /// A publication that describes the method.
    #[serde(default)]
    pub source: Option<String>,
    /// The only items in which it may lose points: the items about the cost of a tree, for a
    /// builder that does not use the surface area heuristic.
    #[serde(default)]
    pub may_lose: Vec<String>,
    /// The crates that it uses although submissions may not.
    #[serde(default)]
    pub crates: Vec<String>,
}

/// The reason why a variant cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum VariantError {
    /// Its file cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// It cannot be completed with given code.
    #[error("{}: {source}", path.display())]
    GivenCode {
        /// The path of the variant.
        path: PathBuf,
        /// The reason.
        source: GivenCodeError,
    },
}

/// Reads the list of all variants of the workspace at `root`.
pub fn variants(root: &Path) -> Result<Vec<Variant>, TomlFileError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        variant: Vec<Variant>,
    }

    let file: File = read_toml(&root.join(FOLDER).join("variants.toml"))?;
    Ok(file.variant)
}

impl Variant {
    /// Returns the name of the task file that it replaces.
    pub fn file(&self) -> String {
        format!("{}.rs", self.id.split('.').next().unwrap_or_default())
    }

    /// Returns the path of its file, relative to the workspace's root.
    pub fn path(&self) -> PathBuf {
        Path::new(FOLDER).join(format!("{}.rs", self.id.replace('.', "/")))
    }

    /// Returns the tasks of the assignment that its file solves.
    pub fn tasks(&self, assignment: &Assignment) -> Vec<Task> {
        assignment.tasks_in(&self.file()).collect()
    }

    /// Returns the reference with one task file replaced by this variant and its given code.
    pub fn apply(&self, reference: &Sources, root: &Path) -> Result<Sources, VariantError> {
        let path = root.join(self.path());
        let own = files::read_to_string(&path)?;
        let file = self.file();
        let given = given_code(reference.text(&file).unwrap_or_default(), &own)
            .map_err(|source| VariantError::GivenCode { path, source })?;
        let sources = reference
            .clone()
            .with_file(&file, format!("{own}\n{given}"));
        Ok(sources.with_crates(&self.crates))
    }
}
