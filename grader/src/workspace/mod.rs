//! The location of the workspace and of the files that the grader writes.

pub mod book;
pub mod bundle_version;
pub mod given_files;
pub mod source_paths;

use std::env;
use std::path::{Path, PathBuf};

use judging::sanitize::sanitize_line;

use crate::error::Error;
use crate::handed_out::HandedOut;

/// The folder that contains `student/` and the lock file.
#[derive(Clone, Debug)]
pub struct Workspace {
    root: PathBuf,
}

/// Returns a path for a message: relative to the current folder if it is inside that folder, and
/// safe to print.
pub fn display_path(path: &Path) -> String {
    let here = env::current_dir().unwrap_or_default();
    let path = path.strip_prefix(here).unwrap_or(path);
    sanitize_line(&path.to_string_lossy(), usize::MAX)
}

impl Workspace {
    /// Finds the workspace around the current folder or, failing that, the one where this program
    /// was built.
    pub fn find() -> Result<Self, Error> {
        let here = env::current_dir().unwrap_or_default();
        let built_in = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
        here.ancestors()
            .chain(built_in)
            .find(|folder| {
                folder.join("student/framework/Cargo.toml").is_file()
                    && folder.join("Cargo.lock").is_file()
            })
            // The path isn't canonicalised: on Windows, that would give a path such as
            // `\\?\C:\...`, which looks odd in messages.
            .map(|root| Workspace {
                root: root.to_owned(),
            })
            .ok_or_else(|| {
                Error::machine(
                    "cannot find the assignment's folder, which contains student/framework: run the \
                     command inside it",
                )
            })
    }

    /// Returns the workspace's root folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Returns the folder of an assignment's reference solution, if it exists.
    pub fn reference(&self, handed_out: &HandedOut) -> Option<PathBuf> {
        let folder = self.root.join(handed_out.reference);
        folder.is_dir().then_some(folder)
    }

    /// Returns the folder for everything the grader writes by default. `cargo clean` removes it.
    /// Each subfolder is named after a submission, except for the caches.
    pub fn output_folder(&self) -> PathBuf {
        self.root.join("target/grade")
    }

    /// Returns the folder for the grader's caches and temporary files. No submission's folder has
    /// this name, since [`safe_folder_name`](judging::sanitize::safe_folder_name) never returns a
    /// name that begins with a dot.
    pub fn cache_folder(&self) -> PathBuf {
        self.output_folder().join(".cache")
    }

    /// Returns the path unchanged if it exists. Otherwise, resolves it relative to the workspace.
    pub fn resolve(&self, path: &Path) -> PathBuf {
        if path.exists() {
            path.to_owned()
        } else {
            self.root.join(path)
        }
    }
}
