//! The folders that are handed out as they stand.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::bundle::Bundle;

/// Folders and single files at the workspace's root.
const COPIED: [&str; 7] = [
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "grader",
    "handout",
    "scenes",
    "student/framework",
    "student/protocol",
];
/// What only the staff needs, wherever it lies in those folders.
const EXCLUDED_NAMES: [&str; 4] = ["tests", "benches", "fuzz", "target"];
/// What students do not have: what grades a class and others' code, and what is written for those who
/// do that.
const STAFF_PATHS: [&str; 6] = [
    "grader/class",
    "grader/SECURITY.md",
    "handout/src/class.md",
    "handout/src/gradescope.md",
    "handout/src/classroom50.md",
    "handout/src/github.md",
];
/// The book's contents, and the part of it that is about those pages.
const SUMMARY: &str = "handout/src/SUMMARY.md";
const STAFF_HEADING: &str = "# For instructors";
/// Made from the reference, and never taken from disk.
const STARTER: &str = "grader/starter";
/// Where an exam may lie that is not to be seen yet.
const EXAMS: &str = "grader/exams";
/// The one that is handed out.
const PRACTICE: &str = "grader/exams/practice.json";

/// A file or folder of the repository can not be used.
#[derive(Debug, thiserror::Error)]
pub enum FoldersError {
    /// The system does not let us.
    #[error("can not read {}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// It is a link or a device, or its name is no text.
    #[error("{} is no plain file: students could not unpack it", .0.display())]
    NotAPlainFile(PathBuf),
}

/// Puts all of them into the bundle.
pub(super) fn copy(root: &Path, bundle: &mut Bundle) -> Result<(), FoldersError> {
    COPIED
        .iter()
        .try_for_each(|part| copy_tree(&root.join(part), part, bundle))
}

/// Takes what is at `place`, and all below it, to the bundle's `path`.
pub(crate) fn copy_tree(place: &Path, path: &str, bundle: &mut Bundle) -> Result<(), FoldersError> {
    let at = |source| FoldersError::Io {
        path: place.to_owned(),
        source,
    };
    let kind = fs::symlink_metadata(place).map_err(at)?.file_type();
    if kind.is_file() {
        let mut bytes = fs::read(place).map_err(at)?;
        if path == SUMMARY {
            bytes.truncate(offset_or_end(&bytes, STAFF_HEADING));
        }
        bundle.insert(path, bytes);
        return Ok(());
    }
    if !kind.is_dir() {
        return Err(FoldersError::NotAPlainFile(place.to_owned()));
    }
    for entry in fs::read_dir(place).map_err(at)? {
        let name = entry.map_err(at)?.file_name();
        let below = place.join(&name);
        let name = name
            .to_str()
            .ok_or_else(|| FoldersError::NotAPlainFile(below.clone()))?;
        let path = format!("{path}/{name}");
        if is_handed_out(&path, name) {
            copy_tree(&below, &path, bundle)?;
        }
    }
    Ok(())
}

/// Where these words begin, if they are there; else the end.
fn offset_or_end(bytes: &[u8], words: &str) -> usize {
    let mut places = bytes.windows(words.len());
    places
        .position(|window| window == words.as_bytes())
        .unwrap_or(bytes.len())
}

fn is_handed_out(path: &str, name: &str) -> bool {
    let secret = path.starts_with(EXAMS) && path != EXAMS && path != PRACTICE;
    let hidden = name.starts_with('.');
    let whole = path == STARTER || STAFF_PATHS.contains(&path);
    !(secret || hidden || whole || EXCLUDED_NAMES.contains(&name))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn handed_out(path: &str) -> bool {
        is_handed_out(path, path.rsplit('/').next().unwrap())
    }

    #[test]
    fn only_the_practice_exam_is_handed_out() {
        assert!(handed_out("grader/exams") && handed_out("grader/exams/practice.json"));
        assert!(!handed_out("grader/exams/final.json"));
    }

    #[test]
    fn staff_and_editor_files_are_not_handed_out() {
        for path in [
            "grader/tests",
            "grader/class",
            "grader/SECURITY.md",
            "handout/src/gradescope.md",
            "student/protocol/tests",
            "scenes/.flat.json.swp",
        ] {
            assert!(!handed_out(path), "{path}");
        }
    }
}
