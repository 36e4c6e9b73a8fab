//! The names of Canvas's files. They contain the IDs of the student and the attachment, as well as
//! any numbers in the student's own file name.

use std::collections::BTreeSet;

use grader::submission::is_archive_name;

use super::names::{SubmissionNode, first_readings};
use super::platforms::Platform;
use super::reader::Reader;
use super::template::Parts;
use crate::entry::Entry;
use crate::file_tree::Node;
use crate::names::{is_number, joined};

impl Reader<'_> {
    /// Returns whether the files could be a download from Canvas. The names of other files may also
    /// contain two numbers, such as parts of a date. Such files can be recognised because they all
    /// have the same number or name where the student's would be, or because two of them have the
    /// same attachment ID.
    pub fn is_canvas_download(&self, names: &[&str]) -> bool {
        let names = names.iter();
        let names = names.map(|name| (name, first_readings(&self.platform.files, name)));
        let names: Vec<_> = names.filter(|(_, ways)| !ways.is_empty()).collect();
        if names.iter().any(|(_, ways)| self.is_listed(&ways[0])) {
            return true;
        }
        let count = |templates: &[&str]| {
            let texts = names.iter().map(|(_, ways)| ways[0].fill_first(templates));
            texts.collect::<BTreeSet<String>>().len()
        };
        let users = count(&["anon_{anonymous}", "{canvas_name}_{number}"]);
        let whos = count(&["{canvas_name}", "anon"]);
        let named = "{canvas_name}_{number}_{attachment}";
        let attachments = count(&[named, "anon_{anonymous}_{attachment}"]);
        let archives = names.iter().filter(|(name, _)| is_archive_name(name));
        let is_anonymous = names.iter().all(|(_, ways)| ways[0].has("anonymous"));
        let is_of_one =
            (users == 1 && archives.count() > 1) || (users > 1 && whos == 1 && !is_anonymous);
        attachments == names.len() && !is_of_one
    }
}

/// Returns the name under which Canvas shows a page: the name of the last attachment, provided that
/// Canvas reads the first two numbers in that name as the IDs of the user and the attachment.
pub(super) fn attachment_name(
    canvas: &'static Platform,
    files: &[SubmissionNode],
) -> Option<String> {
    let archive = files.iter().rfind(|found| found.node.is_archive());
    let SubmissionNode { parts, node, .. } = archive.or(files.last())?;
    let is_zip = node.name.to_lowercase().ends_with(".zip");
    let end = if is_zip { "" } else { ".html" };
    let is_first = first_readings(&canvas.files, &node.name).first() == Some(parts);
    is_first.then(|| format!("{}{end}", node.name))
}

/// Removes the number that Canvas appends to the name of a file that is handed in again.
pub(super) fn without_number(name: &str) -> String {
    let original = || {
        let (stem, end) = name.split_once('.')?;
        let (stem, number) = stem.rsplit_once('-')?;
        is_number(number).then(|| format!("{stem}.{end}"))
    };
    original().unwrap_or_else(|| name.to_owned())
}

/// Returns the entry for a file whose name can be read in several ways.
pub(super) fn ambiguous(ways: &[Parts], node: &Node) -> Entry {
    let users = ways.iter();
    let users = users.map(|parts| parts.fill_first(&["{number} ({canvas_name})"]));
    let users = joined(users, " or ");
    let why = format!(
        "its user number could be {users}: use --canvas to pass a gradebook that contains one of \
         them, or rename the file"
    );
    let mut entry = Entry::left_to_staff(&node.name, why);
    entry.info.late = ways.iter().any(|parts| parts.has("late"));
    entry
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn removes_the_numbers_of_files_that_were_handed_in_again() {
        for (name, original) in [
            ("camera-12.rs", "camera.rs"),
            ("camera-final.rs", "camera-final.rs"),
        ] {
            assert_eq!(without_number(name), original);
        }
    }
}
