//! Finds entries of a plain class that seem to belong to several people: a folder for a tutorial
//! with a folder for each student, or the files of several people side by side, numbered by a
//! browser or a drive. It would be unclear who gets the points.

use grader::handed_out::{HandedOut, TaskFile};

use crate::entry::{Entry, Source};
use crate::listing::Node;
use crate::names::is_number;
use crate::roster::Member;

/// The maximum number of names in a message.
const MAX_NAMES: usize = 3;

/// Marks each entry that seems to belong to several people as one without files. Returns the
/// reasons. An entry of somebody on a list is always one submission, regardless of its folders.
pub(super) fn reject_mixtures(
    root: &Node,
    entries: &mut [Entry],
    handed_out: &HandedOut,
    known: &[Member],
) -> Vec<String> {
    let mut mixtures = Vec::new();
    for entry in entries {
        let Source::Path(path) = &entry.source else {
            continue;
        };
        let Some(node) = root.children().iter().find(|node| node.path == *path) else {
            continue;
        };
        let is_known = || {
            let mut people = entry.info.people.iter();
            people.any(|person| known.iter().any(|member| member.matches(person)))
        };
        let why = side_by_side(node, handed_out).or_else(|| {
            let inside = submissions_inside(node, handed_out)?;
            (!is_known()).then(|| {
                format!(
                    "the folder {} has several submissions ({}): if they are of several students, \
                     pass this folder, or move theirs out of it; if of one, keep the one that counts",
                    node.name,
                    listed(&inside)
                )
            })
        });
        if let Some(why) = why {
            entry.leave_to_staff(why.clone());
            mixtures.push(why);
        }
    }
    mixtures
}

/// Returns the reason a folder seems to contain the files of several people: several versions of task
/// files, or many of one, with numbers appended by a browser or a drive.
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
            "the folder {} has several versions of {} side by side ({}): if they are of several \
             students, put those of each into a folder; if of one, keep those that count",
            node.name,
            match several.len() {
                1 => "a task file".to_owned(),
                count => format!("{count} task files"),
            },
            listed(most)
        )
    })
}

/// Returns whether a name is that of the file or of a numbered copy: `bvh (1).rs` or `bvh(1).rs`.
fn is_version(name: &str, file: &str) -> bool {
    let stem = |name: &str| Some(name.to_lowercase().strip_suffix(".rs")?.to_owned());
    let (Some(name), Some(file)) = (stem(name), stem(file)) else {
        return false;
    };
    let number = || {
        name.strip_prefix(&file)?
            .trim()
            .strip_prefix('(')?
            .strip_suffix(')')
    };
    name == file || number().is_some_and(is_number)
}

/// Returns the names of the subfolders that look like submissions, if there are several and the
/// folder itself isn't a submission. A folder that only contains one other is skipped.
fn submissions_inside<'a>(node: &'a Node, handed_out: &HandedOut) -> Option<Vec<&'a str>> {
    if is_submission(node, handed_out) {
        return None;
    }
    let folders = || node.children().iter().filter(|node| node.is_folder());
    if let [only] = node.children()
        && only.is_folder()
    {
        return submissions_inside(only, handed_out);
    }
    let other_folders = handed_out.assignment.other_folders;
    let inside = folders().filter(|node| !other_folders.contains(&node.name.as_str()));
    let inside = inside.filter(|node| has_task_files(node, handed_out));
    let mut inside: Vec<&str> = inside.map(|node| node.name.as_str()).collect();
    if inside.is_empty() {
        let archives = node.children().iter().filter(|node| node.is_archive());
        inside = archives.map(|node| node.name.as_str()).collect();
    }
    (inside.len() > 1).then_some(inside)
}

/// Returns whether a folder contains repositories but isn't one itself. A repository is recognised by
/// the hidden folder that Git creates, which nobody can hand in, or by its task files.
pub(super) fn is_section(node: &Node, handed_out: &HandedOut) -> bool {
    let is_repository = |node: &Node| node.path.join(".git").exists();
    let has_repositories = || node.children().iter().any(is_repository);
    let is_section = || has_repositories() || submissions_inside(node, handed_out).is_some();
    !node.is_link && !is_repository(node) && is_section()
}

/// Returns whether a folder has task files where people are expected to hand them in.
fn is_submission(node: &Node, handed_out: &HandedOut) -> bool {
    let below = |path: &&str| {
        let mut names = path.split('/').filter(|name| !name.is_empty());
        let folder = names.try_fold(node, Node::find);
        folder.is_some_and(|folder| contains_task_file(folder, handed_out))
    };
    handed_out.assignment.folders.iter().any(below)
}

/// Returns whether a folder has a task file, at any depth that was listed.
fn has_task_files(node: &Node, handed_out: &HandedOut) -> bool {
    let mut inside = node.children().iter();
    contains_task_file(node, handed_out) || inside.any(|node| has_task_files(node, handed_out))
}

fn contains_task_file(folder: &Node, handed_out: &HandedOut) -> bool {
    let mut files = handed_out.file_names();
    files.any(|file| folder.find(file).is_some())
}

fn listed(names: &[&str]) -> String {
    let first = names.iter().take(MAX_NAMES).copied();
    let mut text = Vec::from_iter(first).join(", ");
    if names.len() > MAX_NAMES {
        text += ", …";
    }
    text
}
