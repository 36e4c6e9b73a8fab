//! Compares paths of folders that may not exist yet.

use std::path::{Path, PathBuf};

/// Returns whether `inner` is the folder `outer`, or is in it.
pub fn contains(outer: &Path, inner: &Path) -> bool {
    real_path(inner).starts_with(real_path(outer))
}

/// Returns the path without links.
fn real_path(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut existing = absolute.ancestors();
    let real = existing.find_map(|folder| Some((folder, folder.canonicalize().ok()?)));
    match real {
        Some((folder, real)) => match absolute.strip_prefix(folder) {
            Ok(rest) if rest.as_os_str().is_empty() => real,
            Ok(rest) => real.join(rest),
            Err(_) => absolute.clone(),
        },
        None => absolute.clone(),
    }
}
