//! Where the project lies on this machine, and where the grader may write.

use std::env;
use std::path::{Path, PathBuf};

/// The folder that holds `student/` and the lock file.
#[derive(Clone, Debug)]
pub struct Workspace {
    root: PathBuf,
}

/// There is no workspace to be found.
#[derive(Debug, thiserror::Error)]
#[error(
    "can not find the assignment's folder (the one with student/framework): run the command inside it"
)]
pub struct WorkspaceError;

impl Workspace {
    /// The workspace around the current folder, else the one that this program was built in.
    pub fn find() -> Result<Self, WorkspaceError> {
        let here = env::current_dir().unwrap_or_default();
        let built_in = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
        here.ancestors()
            .chain(built_in)
            .find(|folder| {
                folder.join("student/framework/Cargo.toml").is_file()
                    && folder.join("Cargo.lock").is_file()
            })
            // Not `canonicalize`: on Windows that is a path that nobody would type.
            .map(|root| Workspace {
                root: root.to_owned(),
            })
            .ok_or(WorkspaceError)
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Students' own work.
    pub fn student(&self) -> PathBuf {
        self.root.join("student")
    }

    /// The solved files, where staff has them.
    pub fn reference(&self) -> Option<PathBuf> {
        let folder = self.root.join("reference/src");
        folder.is_dir().then_some(folder)
    }

    /// All that the grader writes unless told otherwise: reports, and what it keeps for the next
    /// run. `cargo clean` takes it away.
    pub fn output_folder(&self) -> PathBuf {
        self.root.join("target/grade")
    }

    /// The path as given if it exists from the current folder, else from the workspace's.
    pub fn resolve(&self, path: &Path) -> PathBuf {
        if path.exists() {
            path.to_owned()
        } else {
            self.root.join(path)
        }
    }
}
