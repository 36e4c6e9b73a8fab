//! The bundle's lock file: the workspace's, without the packages that only staff crates need.
//!
//! Cargo itself removes the packages that are no longer needed. It runs offline, so that it cannot
//! update the remaining packages.

use std::env;
use std::path::Path;
use std::process::Command;

use grader::files::{self, AtPath, PathError};
use tempfile::TempDir;

use crate::bundle::Bundle;
use crate::bundle::archive;

/// The reason why the lock file cannot be created.
#[derive(Debug, thiserror::Error)]
pub enum LockError {
    /// A file operation failed.
    #[error("cannot create the bundle's lock file: {0}")]
    File(#[from] PathError),
    /// Cargo failed.
    #[error("cargo cannot create the bundle's lock file; run `cargo fetch`, then try again:\n{0}")]
    Cargo(String),
}

/// Returns the text of the bundle's lock file.
pub(super) fn lock_file(root: &Path, bundle: &Bundle) -> Result<String, LockError> {
    let folder = TempDir::new().at("create a folder in", env::temp_dir())?;
    archive::write_files(bundle, folder.path())?;
    let lock = folder.path().join("Cargo.lock");
    files::copy(root.join("Cargo.lock"), &lock)?;

    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(&cargo)
        .args(["update", "--workspace", "--offline", "--quiet"])
        .current_dir(folder.path())
        .output()
        .at("run", cargo)?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(LockError::Cargo(message));
    }
    Ok(files::read_to_string(lock)?)
}
