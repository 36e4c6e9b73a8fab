//! Paths of members, which may be malicious.

use std::collections::BTreeMap;

use unicode_normalization::UnicodeNormalization;

use super::{ArchiveError, Member};
use crate::submission::display_name;

/// Returns a member's path with `/` as the separator and without `.` components. Fails if the path
/// leads outside the archive.
pub(super) fn normalize_path(path: &str) -> Result<String, ArchiveError> {
    // Some programs on Windows write `\`, contrary to the standard.
    let path = path.replace('\\', "/");
    let is_absolute = path.starts_with('/') || path.get(1..2) == Some(":");
    if is_absolute || path.split('/').any(|part| part == "..") {
        return Err(ArchiveError::PathOutside(display_name(&path)));
    }
    let parts = path
        .split('/')
        .filter(|part| !part.is_empty() && *part != ".");
    Ok(parts.collect::<Vec<_>>().join("/"))
}

/// Returns an error for each Rust file with the same path as an earlier file. Which of the two
/// files is used would depend on the program that unpacks the archive.
pub(super) fn duplicate_paths(members: &[Member]) -> Vec<ArchiveError> {
    let mut known: BTreeMap<String, &str> = BTreeMap::new();
    let mut errors = Vec::new();
    for member in members {
        let folded = folded_path(&member.path);
        if !folded.ends_with(".rs") {
            continue;
        }
        if let Some(first) = known.insert(folded, &member.path) {
            let (path, first) = (display_name(&member.path), display_name(first));
            errors.push(ArchiveError::DuplicatePath(path, first));
        }
    }
    errors
}

/// Normalises a path for comparison: two paths become equal if any common file system treats them
/// as the same. The result is in lower case (macOS, Windows) and in Unicode's composed form, NFC
/// (macOS), and its names don't end in dots or spaces (Windows).
fn folded_path(path: &str) -> String {
    let folded: String = path.to_lowercase().nfc().collect();
    let names = folded
        .split('/')
        .map(|name| name.trim_end_matches(['.', ' ']));
    names.collect::<Vec<_>>().join("/")
}

/// Rejects a link or device, except in `target/`: Cargo creates hard links there, and nothing is
/// read from it.
pub(super) fn check_special(path: &str) -> Result<(), ArchiveError> {
    if path.split('/').any(|part| part == "target") {
        Ok(())
    } else {
        Err(ArchiveError::NotRegular(display_name(path)))
    }
}
