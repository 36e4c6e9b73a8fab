//! What people have, read into entries: each layout is recognised by looking, and pure.
//!
//! Their shapes are those of the platforms' own exports; what does not fit one is said, never
//! dropped in silence.

mod canvas;
mod github;
mod gradescope;
mod moodle;
mod plain;

use std::collections::BTreeSet;

use grader::given_files::TASK_FILES;

use crate::entry::{Entry, folder_name};
use crate::listing::Node;

pub use github::CLASSROOM50_SCORES;
pub use gradescope::{METADATA, MetadataError};

/// A class, as it was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecognisedClass {
    /// What it looks like.
    pub layout: Layout,
    /// In the order of their ids.
    pub entries: Vec<Entry>,
    /// What belongs to nobody, and why.
    pub unmatched: Vec<UnmatchedPath>,
}

/// Something in the input that is no submission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnmatchedPath {
    /// Its name.
    pub name: String,
    /// Why.
    pub why: String,
}

/// Where an input is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Gradescope's "Export submissions".
    Gradescope,
    /// Canvas's "Download submissions".
    Canvas,
    /// Moodle's "Download all submissions".
    Moodle,
    /// Clones of GitHub Classroom or classroom50.
    GitHub,
    /// A folder of folders or archives.
    Plain,
}

impl Layout {
    /// What people call it.
    pub fn description(self) -> &'static str {
        match self {
            Layout::Gradescope => "a Gradescope export",
            Layout::Canvas => "a Canvas download",
            Layout::Moodle => "a Moodle download",
            Layout::GitHub => "clones from a GitHub classroom",
            Layout::Plain => "folders and archives, one a student",
        }
    }
}

/// The class in this folder. `metadata` is the text of Gradescope's, where there is one.
pub fn recognise(root: &Node, metadata: Option<&str>) -> Result<RecognisedClass, MetadataError> {
    let root = find_class_folder(root);
    let (layout, (mut entries, unmatched)) = if let Some(metadata) = metadata {
        (Layout::Gradescope, gradescope::read(root, metadata)?)
    } else if is_majority(root, |node| canvas::is_name(&node.name)) {
        (Layout::Canvas, canvas::read(root))
    } else if is_majority(root, |node| moodle::parse(&node.name).is_some()) {
        (Layout::Moodle, moodle::read(root))
    } else if github::prefix(root).is_some() {
        (Layout::GitHub, github::read(root))
    } else {
        (Layout::Plain, plain::read(root))
    };
    entries.sort_by(|one, other| one.id.cmp(&other.id));
    make_ids_unique(&mut entries);
    Ok(RecognisedClass {
        layout,
        entries,
        unmatched,
    })
}

/// The folder itself, or the only one in it where that is but a wrapper around the class.
pub fn find_class_folder(root: &Node) -> &Node {
    match root.children() {
        [only] if only.is_folder() && !is_submission(only) => find_class_folder(only),
        _ => root,
    }
}

fn is_task_file(name: &str) -> bool {
    TASK_FILES.iter().any(|file| file.name == name)
}

/// Whether this one folder is somebody's work, and not a class.
fn is_submission(node: &Node) -> bool {
    let is_moodles = moodle::parse(&node.name).is_some();
    let holds = |node: &Node| TASK_FILES.iter().any(|file| node.find(file.name).is_some());
    let below = node.find("src").is_some_and(holds);
    let student = node.find("student").and_then(|student| student.find("src"));
    is_moodles || holds(node) || below || student.is_some_and(holds)
}

/// Whether more than half of what lies here is of a kind.
fn is_majority(root: &Node, is_one: impl Fn(&Node) -> bool) -> bool {
    let count = root.children().iter().filter(|node| is_one(node)).count();
    2 * count > root.children().len()
}

/// Two ids that a file system may take for one get numbers.
fn make_ids_unique(entries: &mut [Entry]) {
    let mut taken = BTreeSet::new();
    for entry in entries {
        let wished = folder_name(&entry.id);
        let mut id = wished.clone();
        let mut number = 2;
        while !taken.insert(id.to_lowercase()) {
            id = format!("{wished}-{number}");
            number += 1;
        }
        entry.id = id;
    }
}

/// What a layout finds.
type LayoutContents = (Vec<Entry>, Vec<UnmatchedPath>);

/// Something that belongs to nobody.
fn unmatched_path(node: &Node, why: &str) -> UnmatchedPath {
    UnmatchedPath {
        name: node.name.clone(),
        why: why.to_owned(),
    }
}

#[cfg(test)]
mod tests;
