//! A folder of folders, of archives, or of both: each is named after whose it is.

use super::{Entries, unmatched};
use crate::entry::{About, Entry, Person, Source};
use crate::listing::Node;

pub(super) fn read(root: &Node) -> Entries {
    let (mut entries, mut others) = (Vec::new(), Vec::new());
    for node in root.nodes() {
        if node.is_folder() || node.is_archive() {
            let name = match node.is_folder() {
                true => node.name.as_str(),
                false => stem(&node.name),
            };
            entries.push(Entry {
                id: name.to_owned(),
                about: About {
                    people: vec![Person::named(name)],
                    from: node.name.clone(),
                    ..About::default()
                },
                source: Source::Path(node.path.clone()),
            });
        } else {
            others.push(unmatched(node, "neither a folder nor an archive"));
        }
    }
    (entries, others)
}

/// Without what says that it is an archive.
fn stem(name: &str) -> &str {
    let lower = name.to_ascii_lowercase();
    let ends = [".tar.gz", ".tgz", ".tar", ".zip", ".rar", ".7z"];
    let end = ends.iter().find(|end| lower.ends_with(**end));
    &name[..name.len() - end.map_or(0, |end| end.len())]
}
