//! The layouts of the platforms' exports. Layouts are recognised by file names, and their entries
//! are listed without opening the submitted files.
//!
//! Files that don't fit the layout are reported, never silently ignored.

mod canvas;
mod class_folder;
mod gradescope;
mod mixture;
mod names;
mod platforms;
mod reader;
mod records;
mod template;
mod times;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use grader::files::{self, PathError};
use grader::handed_out::HandedOut;
use judging::sanitize::safe_folder_name;
use unicode_normalization::UnicodeNormalization;

use self::mixture::is_repository;
use self::names::{common_prefix, first_readings, is_name};
use self::platforms::{
    CLASSROOM50_RESULT, CLASSROOM50_SCORES, Platform, SUBMISSIONS_SUFFIX, TEAMS_SUBMITTED,
};
use self::reader::Reader;
use self::records::{SAKAI_MEMBERS, SAKAI_TIME};
use crate::entry::{Entry, Source};
use crate::error::Error;
use crate::file_tree::{Node, names_inside};
use crate::names::unique_name;
use crate::roster::Member;

pub use crate::layout_kind::{Layout, LayoutChoice};
pub use class_folder::find_class_folder;
pub use gradescope::METADATA;
pub use mixture::side_by_side;

/// The layout and the entries of a class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecognisedClass {
    /// The layout that the input was recognised as.
    pub layout: Layout,
    /// The entries, sorted by id.
    pub entries: Vec<Entry>,
    /// The files and folders that don't belong to any entry.
    pub unmatched: Vec<UnmatchedPath>,
    /// Sentences about how the input was read, for a person to check.
    pub notes: Vec<String>,
    /// The reasons for not grading the entries that seem to belong to several people.
    pub mixtures: Vec<String>,
}

/// A file or folder in the input that doesn't belong to any submission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnmatchedPath {
    /// The name of the file or folder.
    pub name: String,
    /// The reason it doesn't belong to any submission.
    pub why: String,
}

impl UnmatchedPath {
    /// Returns an unmatched path with this name and reason.
    pub fn new(name: impl Into<String>, why: impl Into<String>) -> Self {
        UnmatchedPath {
            name: name.into(),
            why: why.into(),
        }
    }
}

impl Layout {
    /// Returns a description for messages.
    pub fn description(self) -> &'static str {
        &Platform::of(self).description
    }

    /// Finds the list of people in a platform's download and returns its path. `root` is the
    /// class's folder.
    pub fn find_list(self, root: &Node) -> Option<PathBuf> {
        let list = root.find(Platform::of(self).list.as_ref()?)?;
        Some(list.path.clone())
    }

    /// Returns whether a folder can't be a submission in this layout, so that it must contain the
    /// class if it is the only folder. Any name can be the name of a clone.
    pub fn may_contain_class(self, folder: &Node) -> bool {
        let has_clones = || !is_repository(folder) && folder.children().iter().any(is_repository);
        let is_submission =
            is_name(Platform::of(self), &folder.name) && !(self == Layout::GitHub && has_clones());
        folder.is_folder() && !is_submission
    }
}

/// Returns the hidden files and folders in a folder, except those that macOS adds to every folder.
/// They don't belong to any submission.
pub fn hidden_paths(folder: &Path) -> Result<Vec<UnmatchedPath>, PathError> {
    let why = "its name begins with a dot, so it is treated as a hidden file and ignored";
    let paths = files::read_dir(folder)?.into_iter();
    let names = paths.filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned()));
    let is_macos = |name: &str| name == ".DS_Store" || name.starts_with("._");
    let hidden = names.filter(|name| name.starts_with('.') && !is_macos(name));
    Ok(hidden.map(|name| UnmatchedPath::new(name, why)).collect())
}

/// Returns whether a platform writes a file with this name into a submission's folder.
pub fn is_written_into_folders(name: &str) -> bool {
    [SAKAI_TIME, SAKAI_MEMBERS, CLASSROOM50_RESULT].contains(&name)
}

/// Returns whether a file with this name was written by a platform and should be read.
pub fn is_record(name: &str) -> bool {
    let mut own = Platform::all().iter().flat_map(|own| &own.own_files);
    [SAKAI_TIME, SAKAI_MEMBERS].contains(&name)
        || own.any(|own| own == name)
        || !first_readings(&Platform::of(Layout::Blackboard).texts, name).is_empty()
}

/// Returns a folder's entries. Recognises the layout if `choice` doesn't name one. `metadata` is
/// the text of Gradescope's metadata file, if any, and `known` contains the people on the class's
/// lists. The contents of entries are ignored: only names chosen by the platform or the teacher are
/// used.
pub fn recognise(
    choice: &LayoutChoice,
    root: &Node,
    metadata: Option<&str>,
    handed_out: &HandedOut,
    known: &[Member],
) -> Result<RecognisedClass, Error> {
    let reader = |layout| Reader {
        platform: Platform::of(layout),
        handed_out,
        known,
    };
    let layout = match choice.layout {
        Some(layout) => layout,
        None if metadata.is_some() => Layout::Gradescope,
        None => recognise_layout(root, reader)?,
    };
    let mut class = reader(layout).read(root, metadata, choice)?;
    let entries = &mut class.entries;
    reject_links(entries);
    // In the other layouts, the platform says who handed in each entry. By explicitly choosing the
    // plain layout, staff confirm that each entry is one submission.
    if layout == Layout::Plain && choice.layout.is_none() {
        let export = |node: &Node| export_inside(node, reader);
        class.mixtures = mixture::reject_mixtures(root, entries, handed_out, known, export);
    }
    entries.sort_by(|one, other| one.id.cmp(&other.id));
    make_ids_unique(entries);
    Ok(class)
}

/// Returns the layouts that most of the names in a folder fit.
fn layouts_by_names<'a>(names: &[&str], reader: impl Fn(Layout) -> Reader<'a>) -> Vec<Layout> {
    let all = Platform::all().iter();
    let all = all.filter(|own| own.is_known_by_names && is_majority(names, own));
    let all = all.map(|platform| reader(platform.layout));
    let all = all.filter(|own| !own.platform.has_attachments || own.is_canvas_download(names));
    all.map(|reader| reader.platform.layout).collect()
}

/// Returns the layout of an entry that is a platform's export, rather than one person's files from
/// such an export.
fn export_inside<'a>(node: &Node, reader: impl Fn(Layout) -> Reader<'a>) -> Option<Layout> {
    let names = names_inside(node);
    let names = Vec::from_iter(names.iter().map(String::as_str));
    if names.contains(&METADATA) {
        return Some(Layout::Gradescope);
    }
    let layout = layouts_by_names(&names, reader).into_iter().next()?;
    let Platform { files, ids, .. } = Platform::of(layout);
    let people = names.iter();
    let people = people.filter_map(|name| first_readings(files, name).into_iter().next());
    let people: BTreeSet<String> = people.map(|parts| parts.fill_first(ids)).collect();
    (people.len() > 1 || names.iter().any(|name| is_record(name))).then_some(layout)
}

/// Recognises the layout of a folder. Rejects a folder that can be read in two ways.
fn recognise_layout<'a>(
    root: &Node,
    reader: impl Fn(Layout) -> Reader<'a>,
) -> Result<Layout, Error> {
    let names = root.children().iter().map(|node| node.name.as_str());
    match layouts_by_names(&Vec::from_iter(names), reader).as_slice() {
        [] if root.name == TEAMS_SUBMITTED => Ok(Layout::Teams),
        [] if is_github_classroom(root) => Ok(Layout::GitHub),
        [] if are_clones(root) => Err(Error::user(
            "the folders are Git clones whose names all begin in the same way: if this beginning \
             is the assignment's title, pass --layout gitlab or --layout github; if it is part of \
             people's names, pass --layout folders",
        )),
        [] => Ok(Layout::Plain),
        [only] => Ok(*only),
        [one, other, ..] => Err(Error::user(format!(
            "the input can be read in two ways: as {}, or as {}; choose one with --layout {} or \
             --layout {}",
            one.description(),
            other.description(),
            one.name(),
            other.name()
        ))),
    }
}

/// Returns whether all folders are repositories and their names have a common prefix.
fn are_clones(root: &Node) -> bool {
    let folders = || root.children().iter().filter(|node| node.is_folder());
    let names = Vec::from_iter(folders().map(|node| node.name.as_str()));
    !common_prefix(&names, '-').is_empty() && folders().all(is_repository)
}

/// Returns whether the folders are clones from GitHub Classroom or classroom50.
fn is_github_classroom(root: &Node) -> bool {
    let is_clone = |node: &&Node| node.is_folder() && !node.is_link;
    let folders = || root.children().iter().filter(is_clone);
    let names: Vec<&str> = folders().map(|node| node.name.as_str()).collect();
    let has_results = || folders().all(|node| node.find(CLASSROOM50_RESULT).is_some());
    let title = root.name.strip_suffix(SUBMISSIONS_SUFFIX);
    let title = title.unwrap_or_default();
    let is_of_title = |name: &&str| {
        let rest = name.strip_prefix(title);
        rest.is_some_and(|account| account.starts_with('-'))
    };
    (!title.is_empty() && names.iter().any(is_of_title))
        || root.find(CLASSROOM50_SCORES).is_some()
        // A student can add this file but cannot give all folder names a common prefix.
        || (!common_prefix(&names, '-').is_empty() && has_results())
}

/// Rejects links: if an entry's files include a link, marks the entry as having no files.
fn reject_links(entries: &mut [Entry]) {
    for entry in entries {
        let mut paths = entry.source.paths().into_iter();
        if let Some(link) = paths.find(|path| path.is_symlink()) {
            let name = link.file_name().unwrap_or_default().display();
            let why = format!("{name} is a link, and links are not followed");
            entry.source = Source::Missing(why);
        }
    }
}

/// Returns whether more than half of the names are in the platform's format, ignoring files that
/// the platform writes in addition to the submissions.
fn is_majority(names: &[&str], platform: &'static Platform) -> bool {
    let is_own = |name: &&&str| platform.own_files.iter().any(|own| own == **name);
    let names = names.iter().filter(|name| !is_own(name));
    let count = names.clone().filter(|name| is_name(platform, name));
    2 * count.count() > names.count()
}

/// Turns ids into safe folder names and appends numbers to any names that would be equal on a
/// case-insensitive file system.
fn make_ids_unique(entries: &mut [Entry]) {
    let mut used = BTreeSet::new();
    for entry in entries {
        let id: String = entry.id.nfc().collect();
        entry.id = unique_name(&safe_folder_name(&id), "", &mut used);
    }
}

#[cfg(test)]
mod tests;
