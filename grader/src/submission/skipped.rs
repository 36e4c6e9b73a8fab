//! Folders that are never searched for files to grade.

use crate::handed_out::HandedOut;

/// Names of folders that never contain files to grade, but only metadata of systems and tools, old
/// versions kept by tools, or compiled files. The project's own folders are listed in the
/// assignment.
const SKIPPED: [&str; 24] = [
    "__MACOSX",
    "target",
    "node_modules",
    ".git",
    ".github",
    ".gitlab",
    ".svn",
    ".hg",
    ".jj",
    ".cargo",
    ".vscode",
    ".vs",
    ".idea",
    ".fleet",
    ".zed",
    ".history",
    ".devcontainer",
    ".cache",
    ".Trash",
    ".Trashes",
    ".fseventsd",
    ".Spotlight-V100",
    ".TemporaryItems",
    ".DS_Store",
];

/// Returns whether folders with this name are skipped in all assignments.
pub fn is_skipped_name(name: &str) -> bool {
    SKIPPED.contains(&name)
}

/// Returns whether folders with this name are skipped.
pub(super) fn is_skipped(name: &str, handed_out: &HandedOut) -> bool {
    is_skipped_name(name) || handed_out.assignment.other_folders.contains(&name)
}
