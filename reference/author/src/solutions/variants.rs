//! Variants: known correct solutions that differ from the reference. Each file
//! `reference/variants/STEM/NAME.rs` replaces the reference's `STEM.rs`.

use std::path::{Path, PathBuf};

use judging::assignment::{RAYS, Task};
use serde::Deserialize;

use crate::solutions::sources::Sources;
use crate::text_file::{ReadError, read};

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

/// The reason why the list of variants cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum VariantsError {
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The list is invalid.
    #[error("{}: {source}", path.display())]
    Toml {
        /// The path of the list.
        path: PathBuf,
        /// The parse error, with its line and column.
        source: toml::de::Error,
    },
}

/// Reads the list of all variants of the workspace at `root`.
pub fn variants(root: &Path) -> Result<Vec<Variant>, VariantsError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        variant: Vec<Variant>,
    }

    let path = root.join(FOLDER).join("variants.toml");
    let file: Result<File, _> = toml::from_str(&read(&path)?);
    file.map(|file| file.variant)
        .map_err(|source| VariantsError::Toml { path, source })
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

    /// Returns the tasks that its file solves.
    pub fn tasks(&self) -> Vec<Task> {
        let of_file = |task: &Task| RAYS.info(*task).file == self.file();
        RAYS.tasks().filter(of_file).collect()
    }

    /// Returns the reference with one task file replaced by this variant.
    pub fn apply(&self, reference: &Sources, root: &Path) -> Result<Sources, ReadError> {
        let text = read(&root.join(self.path()))?;
        let sources = reference.clone().with_file(&self.file(), text);
        Ok(sources.with_crates(&self.crates))
    }
}
