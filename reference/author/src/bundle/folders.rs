//! Copies the folders that are handed out unchanged.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};
use grader::files::{self, AtPath};

use crate::bundle::Bundle;

/// The folders and files to copy, relative to the workspace's root.
const COPIED: [&str; 7] = [
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "grader",
    "handout",
    "scenes",
    "student/framework",
    "student/protocol",
];
/// The names of folders that only staff need. Folders with these names are skipped wherever they
/// occur.
const EXCLUDED_NAMES: [&str; 5] = ["tests", "snapshots", "benches", "fuzz", "target"];
/// Files and folders about grading a class or running untrusted code, which are only for staff.
const STAFF_PATHS: [&str; 7] = [
    "grader/class",
    "grader/SECURITY.md",
    "handout/src/class.md",
    "handout/src/drill.md",
    "handout/src/gradescope.md",
    "handout/src/classroom50.md",
    "handout/src/github.md",
];
/// The book's table of contents, which is cut off at [`STAFF_HEADING`].
const SUMMARY: &str = "handout/src/SUMMARY.md";
/// The heading of the staff pages in the table of contents.
const STAFF_HEADING: &str = "# For instructors";
/// The grader's copy of the starter. It isn't copied but generated from the reference.
const STARTER: &str = "grader/starter";
/// The folder with the exams. It may contain final exams.
const EXAMS: &str = "grader/exams";
/// The exam that is handed out.
const PRACTICE: &str = "grader/exams/practice.json";

/// Copies the files and folders in `COPIED` into the bundle.
pub(super) fn copy(root: &Path, bundle: &mut Bundle) -> Result<()> {
    COPIED
        .iter()
        .try_for_each(|path| copy_tree(&root.join(path), path, bundle))
}

/// Copies the file `source` or everything in the folder `source` to `path` in the bundle.
pub(crate) fn copy_tree(source: &Path, path: &str, bundle: &mut Bundle) -> Result<()> {
    let kind = fs::symlink_metadata(source).at("read", source)?.file_type();
    if kind.is_file() {
        let mut bytes = files::read(source)?;
        if path == SUMMARY {
            bytes.truncate(offset_or_end(&bytes, STAFF_HEADING));
        }
        bundle.insert(path, bytes);
        return Ok(());
    }
    if !kind.is_dir() {
        bail!(not_plain(source));
    }
    for below in files::read_dir(source)? {
        let name = below.file_name().and_then(OsStr::to_str);
        let name = name.with_context(|| not_plain(&below))?;
        let path = format!("{path}/{name}");
        if is_handed_out(&path, name) {
            copy_tree(&below, &path, bundle)?;
        }
    }
    Ok(())
}

fn not_plain(path: &Path) -> String {
    format!(
        "{} must be a regular file or folder with a UTF-8 name, or students can't unpack it: \
         remove it",
        path.display()
    )
}

/// Returns the names of the instructors' pages in the built book. `path` is the book's path in the
/// bundle.
pub(super) fn staff_pages(path: &str, bundle: &Bundle) -> Vec<String> {
    let chapters = STAFF_PATHS.iter().filter_map(|chapter| {
        let name = chapter.strip_prefix("handout/src/")?;
        Some(name.replace(".md", ".html"))
    });
    chapters
        .filter(|page| bundle.files.contains_key(&format!("{path}/{page}")))
        .collect()
}

/// Returns the offset of the first occurrence of `text`, or the length of `bytes` if it doesn't
/// occur.
fn offset_or_end(bytes: &[u8], text: &str) -> usize {
    let mut windows = bytes.windows(text.len());
    windows
        .position(|window| window == text.as_bytes())
        .unwrap_or(bytes.len())
}

fn is_handed_out(path: &str, name: &str) -> bool {
    let is_secret = path.starts_with(EXAMS) && path != EXAMS && path != PRACTICE;
    let is_hidden = name.starts_with('.');
    let is_excluded =
        path == STARTER || STAFF_PATHS.contains(&path) || EXCLUDED_NAMES.contains(&name);
    !(is_secret || is_hidden || is_excluded)
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
