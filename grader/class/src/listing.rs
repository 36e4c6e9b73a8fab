//! Folder listings, as deep as the layouts need them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The number of levels of subfolders that are listed.
const MAX_DEPTH: usize = 3;
/// Folders that are skipped: they contain nothing that a student has written.
const SKIPPED: [&str; 3] = ["__MACOSX", "target", "node_modules"];

/// A file or a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    /// The file name.
    pub name: String,
    /// The path.
    pub path: PathBuf,
    /// The contents of a folder, in the order of names; `None` for a file.
    pub children: Option<Vec<Node>>,
}

impl Node {
    /// Returns whether this is a folder.
    pub fn is_folder(&self) -> bool {
        self.children.is_some()
    }

    /// Returns the contents of a folder; none for a file.
    pub fn children(&self) -> &[Node] {
        self.children.as_deref().unwrap_or_default()
    }

    /// Returns the file or folder with this name in the folder.
    pub fn find(&self, name: &str) -> Option<&Node> {
        self.children().iter().find(|node| node.name == name)
    }

    /// Returns whether this is an archive by its name, even if the format is not supported.
    pub fn is_archive(&self) -> bool {
        !self.is_folder() && is_archive_name(&self.name)
    }
}

/// Returns whether this is the name of an archive, even if the format is not supported.
pub fn is_archive_name(name: &str) -> bool {
    let lower = name.to_lowercase();
    let ends = [".zip", ".tar", ".tar.gz", ".tgz", ".rar", ".7z"];
    ends.iter().any(|end| lower.ends_with(end))
}

/// Lists a folder. Hidden files and links are left out, and invalid Unicode in names is replaced.
pub fn list_folder(folder: &Path) -> io::Result<Node> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    Ok(Node {
        name: name.into_owned(),
        path: folder.to_owned(),
        children: Some(list_children(folder, MAX_DEPTH)?),
    })
}

fn list_children(folder: &Path, depth: usize) -> io::Result<Vec<Node>> {
    let mut nodes = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.starts_with('.') || SKIPPED.contains(&name.as_str()) {
            continue;
        }
        let kind = entry.file_type()?;
        let inside = match (kind.is_dir(), depth) {
            (true, 0) => Some(Vec::new()),
            (true, _) => Some(list_children(&entry.path(), depth - 1)?),
            (false, _) if kind.is_file() => None,
            (false, _) => continue,
        };
        nodes.push(Node {
            name,
            path: entry.path(),
            children: inside,
        });
    }
    nodes.sort_by(|one, other| one.name.cmp(&other.name));
    Ok(nodes)
}
