//! Variants: known correct solutions that differ from the reference. With the given code of the
//! reference's `STEM.rs`, each file `reference/variants/STEM/NAME.rs` replaces that file. A variant
//! whose files use each other is a folder `reference/variants/STEM/NAME` of several such files.

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
    /// The stem of the file that it replaces, or of one of them, a dot, and a name, such as `sphere.stable_quadratic`.
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
    /// The names of the files that it replaces, if it is a folder of several.
    #[serde(default)]
    pub files: Vec<String>,
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
    /// Returns the name of the task file that it is about: the only one that it replaces, or one of
    /// several.
    pub fn file(&self) -> String {
        format!("{}.rs", self.id.split('.').next().unwrap_or_default())
    }

    /// Returns the names of the task files that it replaces, each with the path of its file,
    /// relative to the workspace's root.
    fn files(&self) -> Vec<(String, PathBuf)> {
        let path = Path::new(FOLDER).join(self.id.replace('.', "/"));
        if self.files.is_empty() {
            return vec![(self.file(), path.with_extension("rs"))];
        }
        let files = self.files.iter();
        files.map(|file| (file.clone(), path.join(file))).collect()
    }

    /// Returns the tasks of the assignment that its files solve.
    pub fn tasks(&self, assignment: &Assignment) -> Vec<Task> {
        let files = self.files().into_iter();
        files
            .flat_map(|(file, _)| assignment.tasks_in(&file).collect::<Vec<_>>())
            .collect()
    }

    /// Returns the reference with the task files replaced by this variant and its given code.
    pub fn apply(&self, reference: &Sources, root: &Path) -> Result<Sources, VariantError> {
        let mut sources = reference.clone();
        for (file, path) in self.files() {
            let path = root.join(path);
            let own = files::read_to_string(&path)?;
            let given = given_code(reference.text(&file).unwrap_or_default(), &own)
                .map_err(|source| VariantError::GivenCode { path, source })?;
            sources = sources.with_file(&file, format!("{own}\n{given}"));
        }
        Ok(sources.with_crates(&self.crates))
    }
}
