//! A folder of folders, archives, or both, each named after its student.

use super::{LayoutContents, unmatched_path};
use crate::entry::{Entry, Person, Source};
use crate::listing::Node;

pub(super) fn read(root: &Node) -> LayoutContents {
    let (mut entries, mut others) = (Vec::new(), Vec::new());
    for node in root.children() {
        if node.is_folder() || node.is_archive() {
            let name = if node.is_folder() {
                node.name.as_str()
            } else {
                strip_archive_extension(&node.name)
            };
            let source = Source::Path(node.path.clone());
            let person = Person::named_by_file(name);
            entries.push(Entry::new(name, person, &node.name, source));
        } else {
            others.push(unmatched_path(node, "neither a folder nor an archive"));
        }
    }
    (entries, others)
}

/// Returns the name without the archive's extension.
fn strip_archive_extension(name: &str) -> &str {
    let lower = name.to_ascii_lowercase();
    let ends = [
        ".tar.gz", ".tar.xz", ".tar.bz2", ".tar.zst", ".tgz", ".txz", ".tar", ".zip", ".rar",
        ".7z", ".gz", ".xz",
    ];
    let end = ends.iter().find(|end| lower.ends_with(**end));
    &name[..name.len() - end.map_or(0, |end| end.len())]
}
