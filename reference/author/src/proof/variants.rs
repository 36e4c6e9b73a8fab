//! Other right solutions: `reference/variants/STEM/NAME.rs`, each in the place of the reference's
//! `STEM.rs`.

use std::path::{Path, PathBuf};

use grader::exam::Task;
use serde::Deserialize;

use crate::proof::sources::{ReadError, Sources, read};

/// Where they stand.
const FOLDER: &str = "reference/variants";

/// A known right solution.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// The file's name without its end, a dot, and a name: `sphere.stable_quadratic`.
    pub id: String,
    /// How it goes about it.
    pub title: String,
    /// Where that is described.
    #[serde(default)]
    pub source: Option<String>,
    /// The only items in which it may lose points: what a tree costs that is not built by the
    /// surface area heuristic.
    #[serde(default)]
    pub may_lose: Vec<String>,
    /// The crates that it names and submissions may not.
    #[serde(default)]
    pub crates: Vec<String>,
}

/// The list can not be used.
#[derive(Debug, thiserror::Error)]
pub enum VariantsError {
    /// A file can not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The list is not one.
    #[error("{}: {source}", path.display())]
    Toml {
        /// The list.
        path: PathBuf,
        /// Line, column, and what is wrong there.
        source: toml::de::Error,
    },
}

/// All variants of the workspace at `root`.
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
    /// The one of the five files that it replaces.
    pub fn file(&self) -> String {
        format!("{}.rs", self.id.split('.').next().unwrap_or_default())
    }

    /// Its own file, from the workspace's root.
    pub fn path(&self) -> PathBuf {
        Path::new(FOLDER).join(format!("{}.rs", self.id.replace('.', "/")))
    }

    /// The tasks that it solves.
    pub fn tasks(&self) -> Vec<Task> {
        let of_file = |task: &Task| task.file() == self.file();
        Task::ALL.into_iter().filter(of_file).collect()
    }

    /// The reference with this file in the place of its own.
    pub fn apply(&self, reference: &Sources, root: &Path) -> Result<Sources, ReadError> {
        let text = read(&root.join(self.path()))?;
        let sources = reference.clone().with_file(&self.file(), text);
        Ok(sources.with_crates(&self.crates))
    }
}
