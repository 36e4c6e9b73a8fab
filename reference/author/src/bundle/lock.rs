//! The bundle's lock file: the workspace's lock file without the packages that only staff crates
//! need.
//!
//! Cargo itself removes the packages that are no longer needed. It runs offline, so that it cannot
//! update the remaining packages.

use std::env;
use std::path::Path;
use std::process::Command;

use anyhow::{Result, bail};
use grader::files::{self, AtPath};
use tempfile::TempDir;

use crate::bundle::Bundle;
use crate::bundle::archive;

/// Returns the text of the bundle's lock file.
pub(super) fn lock_file(root: &Path, bundle: &Bundle) -> Result<String> {
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
        bail!(
            "cargo cannot create the bundle's lock file; run `cargo fetch`, then try again:\n{}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
    Ok(files::read_to_string(lock)?)
}
