//! The lock file: ours, without what only the staff's crates need.
//!
//! Which of our packages are still needed is for cargo to say. It is asked without the network, so
//! that it can only take away, never update.

use std::env;
use std::fs;
use std::io;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use crate::bundle::Bundle;
use crate::bundle::archive;

/// There is no lock file.
#[derive(Debug, thiserror::Error)]
pub enum LockError {
    /// The system does not let us.
    #[error("can not make the bundle's lock file: {0}")]
    Io(#[from] io::Error),
    /// Cargo can not make it from ours.
    #[error("cargo can not make the bundle's lock file; run `cargo fetch`, then try again:\n{0}")]
    Cargo(String),
}

/// The text of the lock file.
pub(super) fn lock_file(root: &Path, bundle: &Bundle) -> Result<String, LockError> {
    let folder = TempDir::new()?;
    archive::write_files(bundle, folder.path())?;
    let lock = folder.path().join("Cargo.lock");
    fs::copy(root.join("Cargo.lock"), &lock)?;

    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["update", "--workspace", "--offline", "--quiet"])
        .current_dir(folder.path())
        .output()?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(LockError::Cargo(said));
    }
    Ok(fs::read_to_string(lock)?)
}
