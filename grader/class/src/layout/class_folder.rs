//! Finds the folder with the entries. In an archive, this is often a subfolder.
//!
//! A single folder may be the class itself or the class's only submission. Its contents aren't used
//! to tell the two cases apart, because a student may have written them. Its name is used if a
//! platform or a teacher chose it.

use super::METADATA;
use super::platforms::{SAKAI_ARCHIVE, TEAMS_DRAFTS, TEAMS_SUBMITTED};
use crate::file_tree::Node;
use crate::names::{fold, is_number};

/// Returns the folder with the entries, and a note if this folder isn't `root` or if a different
/// folder could be meant. `archive` is the name of the archive that the folder was unpacked from.
pub fn find_class_folder<'a>(root: &'a Node, archive: Option<&str>) -> (&'a Node, Option<String>) {
    if let Some(found) = find_teams_folder(root) {
        return found;
    }
    let [only] = root.children() else {
        return (root, None);
    };
    if !only.is_folder() || only.is_link {
        return (root, None);
    }
    let name = &only.name;
    let is_sakais = root.name.starts_with(SAKAI_ARCHIVE);
    let is_packed = || archive.is_some_and(|archive| is_packed(name, archive));
    if is_gradescopes(only) || is_sakais || is_packed() {
        let note = format!("the submissions are in the folder {name}");
        return (only, Some(note));
    }
    let unpack = archive.map_or("", |_| "unpack the archive and ");
    let note = format!(
        "the only folder is {name}, which is treated as one submission; if it contains the whole \
         class, {unpack}pass its path"
    );
    (root, Some(note))
}

/// Returns the folder that contains the submissions in a Microsoft Teams library, and a note. The
/// rest of the library only contains drafts.
fn find_teams_folder(root: &Node) -> Option<(&Node, Option<String>)> {
    let names = root.children().iter().map(|node| node.name.as_str());
    let mut others = names.filter(|name| *name != TEAMS_SUBMITTED);
    let submitted = root.find(TEAMS_SUBMITTED)?;
    let drafts = match (others.next(), others.next()) {
        (None, _) => "",
        (Some(TEAMS_DRAFTS), None) => "; those in Working files are drafts",
        (Some(_), _) => return None,
    };
    let note = format!("the submissions are in the folder {TEAMS_SUBMITTED}{drafts}");
    Some((submitted, Some(note)))
}

/// Returns whether a folder is named like an export from Gradescope, such as
/// `assignment_55_export`.
fn is_gradescopes(node: &Node) -> bool {
    let number = node.name.strip_prefix("assignment_");
    let number = number.and_then(|rest| rest.strip_suffix("_export"));
    number.is_some_and(is_number) && node.find(METADATA).is_some()
}

/// Returns whether an archive is named after the folder in it, which suggests that somebody packed
/// this folder. Cloud drives and browsers may have appended a time or a number to the archive's
/// name.
fn is_packed(folder: &str, archive: &str) -> bool {
    let letters =
        |name: &str| -> String { fold(name).chars().filter(|c| c.is_alphanumeric()).collect() };
    let (folder, archive) = (letters(folder), letters(archive));
    let is_end = |rest: &str| {
        let ends = ["zip", "tar", "tgz"];
        !rest.starts_with(char::is_alphabetic) || ends.iter().any(|end| rest.starts_with(end))
    };
    !folder.is_empty() && archive.strip_prefix(&folder).is_some_and(is_end)
}
