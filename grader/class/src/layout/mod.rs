//! The layouts of the platforms' exports. A layout is recognised by its file names, and its entries
//! are listed without opening the submitted files.
//!
//! Files that do not fit the layout are reported, never silently ignored.

mod canvas;
mod class_folder;
mod github;
mod gradescope;
mod mixture;
mod moodle;
mod plain;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use grader::handed_out::HandedOut;
use judging::sanitize::safe_folder_name;
use unicode_normalization::UnicodeNormalization;

use crate::entry::{Entry, Source};
use crate::error::Error;
use crate::listing::Node;
use crate::roster::Member;

pub use class_folder::find_class_folder;
pub use github::CLASSROOM50_SCORES;
pub use gradescope::METADATA;
pub use mixture::side_by_side;

/// The layout and the entries of a class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecognisedClass {
    /// The layout that the input was recognised as.
    pub layout: Layout,
    /// The entries, in the order of their ids.
    pub entries: Vec<Entry>,
    /// The files and folders that belong to no entry.
    pub unmatched: Vec<UnmatchedPath>,
    /// Sentences about how the input was read, for a person to check.
    pub notes: Vec<String>,
    /// For each entry that seems to be several people's and is not graded, the reason.
    pub mixtures: Vec<String>,
}

/// A file or folder in the input that belongs to no submission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnmatchedPath {
    /// The name of the file or folder.
    pub name: String,
    /// The reason why the file or folder belongs to no submission.
    pub why: String,
}

/// A layout of the input, named after the platform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Gradescope's "Export submissions".
    Gradescope,
    /// Canvas's "Download submissions".
    Canvas,
    /// Moodle's "Download all submissions".
    Moodle,
    /// Clones of repositories from GitHub Classroom or classroom50.
    GitHub,
    /// A folder with a folder or archive for each student.
    Plain,
}

impl Layout {
    /// Returns a description for messages.
    pub fn description(self) -> &'static str {
        match self {
            Layout::Gradescope => "a Gradescope export",
            Layout::Canvas => "a Canvas download",
            Layout::Moodle => "a Moodle download",
            Layout::GitHub => "clones from a GitHub classroom",
            Layout::Plain => "folders and archives, one per student",
        }
    }
}

/// Recognises the layout of a folder and returns its entries. `metadata` is the text of
/// Gradescope's metadata file, if there is one, and `known` are the people on lists. Only names in the
/// folder itself count, which the platform or the teacher has chosen, and nothing in an entry.
pub fn recognise(
    root: &Node,
    metadata: Option<&str>,
    handed_out: &HandedOut,
    known: &[Member],
) -> Result<RecognisedClass, Error> {
    let (layout, (mut entries, unmatched)) = if let Some(metadata) = metadata {
        (Layout::Gradescope, gradescope::read(root, metadata)?)
    } else if is_majority(root, |node| canvas::is_name(&node.name))
        && canvas::is_download(root, known)
    {
        (Layout::Canvas, canvas::read(root, handed_out, known))
    } else if is_majority(root, |node| moodle::parse(&node.name).is_some()) {
        (Layout::Moodle, moodle::read(root))
    } else if github::prefix(root).is_some() {
        (Layout::GitHub, github::read(root))
    } else {
        (Layout::Plain, plain::read(root))
    };
    reject_links(root, &mut entries);
    let mixtures = match layout {
        Layout::Plain => mixture::reject_mixtures(root, &mut entries, handed_out, known),
        // These say who has handed in each entry.
        Layout::Gradescope | Layout::Canvas | Layout::Moodle | Layout::GitHub => Vec::new(),
    };
    entries.sort_by(|one, other| one.id.cmp(&other.id));
    make_ids_unique(&mut entries);
    Ok(RecognisedClass {
        layout,
        entries,
        unmatched,
        notes: Vec::new(),
        mixtures,
    })
}

/// Marks each entry whose files include a link as an entry without files.
fn reject_links(root: &Node, entries: &mut [Entry]) {
    let links = root.children().iter().filter(|node| node.is_link);
    let links: BTreeMap<&Path, &str> = links
        .map(|node| (node.path.as_path(), node.name.as_str()))
        .collect();
    for entry in entries {
        let link = match &entry.source {
            Source::Path(path) => links.get(path.as_path()),
            Source::Files(files) => files.iter().find_map(|(_, path)| links.get(path.as_path())),
            Source::Missing(_) => None,
        };
        if let Some(name) = link {
            let why = format!("{name} is a link, and links are not followed");
            entry.source = Source::Missing(why);
        }
    }
}

/// Returns whether `is_one` is true for more than half of the files and folders in `root`.
fn is_majority(root: &Node, is_one: impl Fn(&Node) -> bool) -> bool {
    let count = root.children().iter().filter(|node| is_one(node)).count();
    2 * count > root.children().len()
}

/// Turns ids into safe folder names, and appends numbers to those that would be equal on a file
/// system that ignores case.
fn make_ids_unique(entries: &mut [Entry]) {
    let mut used = BTreeSet::new();
    for entry in entries {
        let id: String = entry.id.nfc().collect();
        let wanted = safe_folder_name(&id);
        let mut id = wanted.clone();
        let mut number = 2;
        while !used.insert(id.to_lowercase()) {
            id = format!("{wanted}-{number}");
            number += 1;
        }
        entry.id = id;
    }
}

/// The entries of a layout, and the paths that belong to none.
type LayoutContents = (Vec<Entry>, Vec<UnmatchedPath>);

/// Returns a path that belongs to no entry, with the reason.
fn unmatched_path(node: &Node, why: &str) -> UnmatchedPath {
    UnmatchedPath {
        name: node.name.clone(),
        why: why.to_owned(),
    }
}

#[cfg(test)]
mod tests;
