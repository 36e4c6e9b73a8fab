//! Lists the contents of folders, but only to the depth that the layouts need.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grader::disk::{self, Operation};
use grader::files::{AtPath, PathError};
use grader::submission::{Archive, ArchiveLimits, is_archive_name, is_skipped_name};

/// The number of subfolder levels to list. This is enough for a project inside a student's folder
/// that is itself inside a tutorial's folder.
const MAX_DEPTH: usize = 5;

/// A file, a folder, or a link to a file or folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    /// The name, i.e. the last component of the path.
    pub name: String,
    /// The path of the file, folder or link.
    pub path: PathBuf,
    /// The contents of a folder, sorted by name. `None` for a file, and empty for a link to a
    /// folder.
    pub children: Option<Vec<Node>>,
    /// Whether this is a link. Links aren't followed, because they may lead to another student's
    /// files.
    pub is_link: bool,
}

impl Node {
    /// Returns whether this is a folder.
    pub fn is_folder(&self) -> bool {
        self.children.is_some()
    }

    /// Returns the contents of a folder, or an empty slice for a file.
    pub fn children(&self) -> &[Node] {
        self.children.as_deref().unwrap_or_default()
    }

    /// Returns the file or folder with this name in the folder, unless it is a link.
    pub fn find(&self, name: &str) -> Option<&Node> {
        let mut children = self.children().iter();
        children.find(|node| node.name == name && !node.is_link)
    }

    /// Returns whether this file is named like an archive, even if the format isn't supported.
    pub fn is_archive(&self) -> bool {
        !self.is_folder() && is_archive_name(&self.name)
    }
}

/// Returns the names in a folder, in an archive, or in an archive's only folder.
pub fn names_inside(node: &Node) -> BTreeSet<String> {
    if let Some(inside) = &node.children {
        return inside.iter().map(|node| node.name.clone()).collect();
    }
    let archive = Archive::open(&node.path, ArchiveLimits::class());
    let listing = archive.and_then(|mut archive| archive.listing());
    let members = listing.map_or(Vec::new(), |listing| listing.members);
    let names = |depth| -> BTreeSet<String> {
        let names = members.iter();
        let names = names.filter_map(|member| member.path.split('/').nth(depth));
        let names = names.filter(|name| !is_skipped_name(name));
        names.map(str::to_owned).collect()
    };
    let outer = names(0);
    if outer.len() == 1 { names(1) } else { outer }
}

/// Lists a folder. Hidden and skipped files and folders are left out, and invalid Unicode in names
/// is replaced.
pub fn list_folder(folder: &Path) -> Result<Node, PathError> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    Ok(Node {
        name: name.into_owned(),
        path: folder.to_owned(),
        children: Some(list_children(folder, MAX_DEPTH).at("read", folder)?),
        is_link: false,
    })
}

fn list_children(folder: &Path, depth: usize) -> io::Result<Vec<Node>> {
    let mut nodes = Vec::new();
    disk::before(Operation::List(folder))?;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.starts_with('.') || is_skipped_name(&name) {
            continue;
        }
        let kind = entry.file_type()?;
        let inside = if kind.is_symlink() {
            // List a link to a folder as an empty folder, so that it becomes an entry and is then
            // rejected for being a link.
            entry.path().is_dir().then(Vec::new)
        } else if kind.is_dir() {
            Some(match depth {
                0 => Vec::new(),
                // Reading the submission will report the error, for this student only.
                _ => list_children(&entry.path(), depth - 1).unwrap_or_default(),
            })
        } else if kind.is_file() {
            None
        } else {
            continue;
        };
        nodes.push(Node {
            name,
            path: entry.path(),
            children: inside,
            is_link: kind.is_symlink(),
        });
    }
    nodes.sort_by(|one, other| one.name.cmp(&other.name));
    Ok(nodes)
}
