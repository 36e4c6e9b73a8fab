//! Finds entries of a plain class that seem to belong to several people: a tutorial's folder with a
//! folder for each student, or several people's files side by side, with file names that a browser
//! or cloud drive has numbered. It would be unclear who gets the points for such an entry.

use grader::handed_out::{HandedOut, TaskFile};

use super::Layout;
use crate::entry::{Entry, Source};
use crate::file_tree::Node;
use crate::names::{is_number, joined};
use crate::roster::Member;

/// The maximum number of names in a message.
const MAX_NAMES: usize = 3;

/// If an entry seems to belong to several people, marks it as having no files. Returns the reasons.
/// An entry that belongs to somebody on a list always counts as one submission, whatever folders it
/// contains.
pub(super) fn reject_mixtures(
    root: &Node,
    entries: &mut [Entry],
    handed_out: &HandedOut,
    known: &[Member],
    export: impl Fn(&Node) -> Option<Layout>,
) -> Vec<String> {
    let mut mixtures = Vec::new();
    for entry in entries {
        let is_source =
            |node: &&Node| matches!(&entry.source, Source::Path(path) if *path == node.path);
        let Some(node) = root.children().iter().find(is_source) else {
            continue;
        };
        let is_known = || {
            let mut people = entry.info.people.iter();
            people.any(|person| known.iter().any(|member| member.matches(person)))
        };
        let of_platform = || {
            let layout = export(node).filter(|_| !is_known())?;
            let (what, name, file) = (layout.description(), layout.name(), &node.name);
            let or = format!(", or use --layout {name}");
            let or = if node.is_folder() { or } else { String::new() };
            Some(format!(
                "{file} is {what}, not one submission: pass its path{or}; to grade several \
                 downloads as one class, unpack them into one folder"
            ))
        };
        let of_students = || {
            let inside = submissions_inside(node, handed_out).filter(|_| !is_known())?;
            Some(format!(
                "the folder {} contains several submissions ({}): if they are from different \
                 students, pass this folder, or move them out of it; if they are attempts by one \
                 student, keep only the one that should be graded; if each contains part of one \
                 submission, combine them in one folder",
                node.name,
                listed(&inside)
            ))
        };
        let side_by_side = || side_by_side(node, handed_out);
        let why = of_platform().or_else(side_by_side).or_else(of_students);
        if let Some(why) = why {
            entry.leave_to_staff(why.clone());
            mixtures.push(why);
        }
    }
    mixtures
}

/// Returns the reason a folder seems to contain the files of several people: several versions of
/// more than one task file, or at least three versions of a single task file. The names of the
/// versions differ only in the numbers that a browser or cloud drive has added.
pub fn side_by_side(node: &Node, handed_out: &HandedOut) -> Option<String> {
    let versions = |file: &TaskFile| -> Vec<&str> {
        let names = node.children().iter().filter(|node| !node.is_folder());
        let names = names.map(|node| node.name.as_str());
        names.filter(|name| is_version(name, file.name)).collect()
    };
    let versions = handed_out.files.iter().map(versions);
    let several: Vec<Vec<&str>> = versions.filter(|names| names.len() > 1).collect();
    let most = several.iter().max_by_key(|names| names.len())?;
    (several.len() > 1 || most.len() > 2).then(|| {
        format!(
            "the folder {} contains several versions of {} side by side ({}): if they are from \
             different students, put each student's files into a separate folder; if they are from \
             one student, keep only those that should be graded",
            node.name,
            match several.len() {
                1 => "a task file".to_owned(),
                count => format!("{count} task files"),
            },
            listed(most)
        )
    })
}

/// Returns whether a name is the file's name or the name of a numbered copy, such as `bvh (1).rs`
/// or `bvh(1).rs`.
fn is_version(name: &str, file: &str) -> bool {
    let (name, file) = (name.to_lowercase(), file.to_lowercase());
    let number = || {
        let copy = name.strip_suffix(".rs")?;
        let number = copy.strip_prefix(file.strip_suffix(".rs")?)?.trim();
        number.strip_prefix('(')?.strip_suffix(')')
    };
    name == file || number().is_some_and(is_number)
}

/// Returns the names of the subfolders that look like submissions, if there are several and the
/// folder itself isn't a submission. If a folder contains nothing but another folder, looks inside
/// the inner folder instead.
fn submissions_inside<'a>(node: &'a Node, handed_out: &HandedOut) -> Option<Vec<&'a str>> {
    if is_submission(node, handed_out) {
        return None;
    }
    if let [only] = node.children()
        && only.is_folder()
    {
        return submissions_inside(only, handed_out);
    }
    let other_folders = handed_out.assignment.other_folders;
    let inside = node.children().iter().filter(|node| {
        let is_other = other_folders.contains(&node.name.as_str());
        node.is_folder() && !is_other && has_task_files(node, handed_out)
    });
    let mut inside: Vec<&str> = inside.map(|node| node.name.as_str()).collect();
    if inside.is_empty() {
        let archives = node.children().iter().filter(|node| node.is_archive());
        inside = archives.map(|node| node.name.as_str()).collect();
    }
    (inside.len() > 1).then_some(inside)
}

/// Returns whether a folder contains repositories but isn't one itself. A repository is recognised
/// by its task files or by the hidden folder `.git`, which can't be part of a submission because
/// Git never commits it.
pub(super) fn is_section(node: &Node, handed_out: &HandedOut) -> bool {
    let has_repositories = || node.children().iter().any(is_repository);
    let is_section = || has_repositories() || submissions_inside(node, handed_out).is_some();
    !node.is_link && !is_repository(node) && is_section()
}

/// Returns whether a folder is a clone of a repository.
pub(super) fn is_repository(node: &Node) -> bool {
    node.path.join(".git").exists()
}

/// Returns whether a folder has task files in one of the locations where students are expected to
/// put them.
fn is_submission(node: &Node, handed_out: &HandedOut) -> bool {
    let below = |path: &&str| {
        let mut names = path.split('/').filter(|name| !name.is_empty());
        let folder = names.try_fold(node, Node::find);
        folder.is_some_and(|folder| contains_task_file(folder, handed_out))
    };
    handed_out.assignment.folders.iter().any(below)
}

/// Returns whether a folder contains a task file at any of the listed depths.
fn has_task_files(node: &Node, handed_out: &HandedOut) -> bool {
    let mut inside = node.children().iter();
    contains_task_file(node, handed_out) || inside.any(|node| has_task_files(node, handed_out))
}

fn contains_task_file(folder: &Node, handed_out: &HandedOut) -> bool {
    let mut files = handed_out.file_names();
    files.any(|file| folder.find(file).is_some())
}

fn listed(names: &[&str]) -> String {
    let more = (names.len() > MAX_NAMES).then_some(&"…");
    joined(names.iter().take(MAX_NAMES).chain(more), ", ")
}
