//! Paths of folders that may not exist yet.

use std::path::{Path, PathBuf};

/// Returns whether `inner` is the folder `outer` or inside it.
pub fn contains(outer: &Path, inner: &Path) -> bool {
    real_path(inner).starts_with(real_path(outer))
}

/// Returns the path with its links resolved.
fn real_path(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut existing = absolute.ancestors();
    let real = existing.find_map(|folder| {
        let rest = absolute.strip_prefix(folder).ok()?;
        Some(folder.canonicalize().ok()?.join(rest))
    });
    real.unwrap_or_else(|| absolute.clone())
}

/// Returns the path of a file next to a folder. The file's name begins with the folder's name.
pub fn beside(folder: &Path, end: &str) -> PathBuf {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    folder.with_file_name(format!("{name}-{end}"))
}
