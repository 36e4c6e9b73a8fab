//! What students get: a folder that builds, grades and explains itself, and holds no solution.
//!
//! Nothing of it is kept by hand. The starter is projected from the reference, the manifests and
//! the lock file are cut from ours, and a few files that only students see stand in `own/`. Before
//! anything is handed out, all of it is searched for what must stay here: see [`secrets`].

pub mod archive;
pub mod check;
pub mod crates;
mod lock;
mod manifests;
pub mod parts;
pub mod secrets;
mod untested;

use std::collections::BTreeMap;
use std::path::Path;

use crate::bundle::lock::NoLock;
use crate::bundle::manifests::BadManifest;
use crate::bundle::parts::Unusable;
use crate::starter::{self, StarterError};

/// The files that only students see, with their places.
const OWN: [(&str, &str); 4] = [
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
pub enum NoBundle {
    /// A file or folder of the repository can not be used.
    #[error(transparent)]
    Unusable(#[from] Unusable),
    /// There is no starter.
    #[error(transparent)]
    Starter(#[from] StarterError),
    /// A manifest is not as expected.
    #[error(transparent)]
    Manifest(#[from] BadManifest),
    /// There is no lock file.
    #[error(transparent)]
    Lock(#[from] NoLock),
}

impl Bundle {
    /// The bundle of the workspace at `root`, with the handout as a book if there is one.
    pub fn collect(root: &Path, book: Option<&Path>) -> Result<Self, NoBundle> {
        let mut bundle = Bundle::default();
        parts::copy(root, &mut bundle)?;
        untested::take_away(&mut bundle);
        if let Some(book) = book {
            parts::take(book, "handout/book", &mut bundle)?;
        }
        for (path, text) in OWN {
            bundle.put(path, text);
        }
        // Never from disk: whoever tries the assignment does so in `student/src`.
        for file in starter::generated(root)? {
            bundle.put(file.path, file.contents);
        }
        manifests::cut(root, &mut bundle)?;
        let lock = lock::locked(root, &bundle)?;
        bundle.put("Cargo.lock", lock);
        Ok(bundle)
    }

    /// Puts a file in its place, or another one in the place of one that is there.
    pub fn put(&mut self, path: impl Into<String>, contents: impl Into<Vec<u8>>) {
        self.files.insert(path.into(), contents.into());
    }

    /// The text of a file. None if it is not there, or no text.
    pub fn text(&self, path: &str) -> Option<&str> {
        std::str::from_utf8(self.files.get(path)?).ok()
    }

    /// The files that are text, with their paths.
    pub fn texts(&self) -> impl Iterator<Item = (&str, &str)> {
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
