//! What students get: a folder that builds, grades and explains itself, and holds no solution.
//!
//! Nothing of it is kept by hand. The starter is projected from the reference, the manifests and
//! the lock file are cut from ours, and a few files that only students see stand in `own/`. Before
//! anything is handed out, all of it is searched for what must stay here: see [`secrets`].

pub mod archive;
pub mod check;
pub mod crates;
pub mod folders;
mod lock;
mod manifests;
pub mod secrets;
mod test_modules;

use std::collections::BTreeMap;
use std::path::Path;

use crate::bundle::folders::FoldersError;
use crate::bundle::lock::LockError;
use crate::bundle::manifests::ManifestError;
use crate::starter::{self, StarterError};

/// The files that only students see, with their places.
const STUDENT_ONLY: [(&str, &str); 4] = [
    ("README.md", include_str!("own/README.md")),
    (".gitignore", include_str!("own/gitignore")),
    (".gitattributes", include_str!("own/gitattributes")),
    (".github/workflows/grade.yml", include_str!("own/grade.yml")),
];

/// All files that are handed out: path, with `/`, and contents.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bundle {
    /// In the order of their paths, so that the same tree gives the same bytes.
    pub files: BTreeMap<String, Vec<u8>>,
}

/// Why there is no bundle.
#[derive(Debug, thiserror::Error)]
pub enum BundleError {
    /// A file or folder of the repository can not be used.
    #[error(transparent)]
    Folders(#[from] FoldersError),
    /// There is no starter.
    #[error(transparent)]
    Starter(#[from] StarterError),
    /// A manifest is not as expected.
    #[error(transparent)]
    Manifest(#[from] ManifestError),
    /// There is no lock file.
    #[error(transparent)]
    Lock(#[from] LockError),
}

impl Bundle {
    /// The bundle of the workspace at `root`, with the handout as a book if there is one.
    pub fn collect(root: &Path, book: Option<&Path>) -> Result<Self, BundleError> {
        let mut bundle = Bundle::default();
        folders::copy(root, &mut bundle)?;
        test_modules::remove(&mut bundle);
        if let Some(book) = book {
            folders::copy_tree(book, "handout/book", &mut bundle)?;
        }
        for (path, text) in STUDENT_ONLY {
            bundle.insert(path, text);
        }
        // Never from disk: whoever tries the assignment does so in `student/src`.
        for file in starter::generated_files(root)? {
            bundle.insert(file.path, file.contents);
        }
        manifests::add_trimmed(root, &mut bundle)?;
        let lock = lock::lock_file(root, &bundle)?;
        bundle.insert("Cargo.lock", lock);
        Ok(bundle)
    }

    /// Puts a file in its place, or another one in the place of one that is there.
    pub fn insert(&mut self, path: impl Into<String>, contents: impl Into<Vec<u8>>) {
        self.files.insert(path.into(), contents.into());
    }

    /// The text of a file. None if it is not there, or no text.
    pub fn text(&self, path: &str) -> Option<&str> {
        std::str::from_utf8(self.files.get(path)?).ok()
    }

    /// The files that are text, with their paths.
    pub fn text_files(&self) -> impl Iterator<Item = (&str, &str)> {
        let files = self.files.iter();
        files.filter_map(|(path, contents)| {
            Some((path.as_str(), std::str::from_utf8(contents).ok()?))
        })
    }

    /// The size of all files, in bytes.
    pub fn size(&self) -> usize {
        self.files.values().map(Vec::len).sum()
    }
}
