//! Clones of a GitHub classroom: repositories that all begin with the assignment's name and end
//! with the account's. GitHub Classroom put them into `ASSIGNMENT-submissions`; classroom50 lays
//! `scores.csv` beside them.

use super::{LayoutContents, unmatched_path};
use crate::entry::{Entry, EntryInfo, Person, Source};
use crate::listing::Node;

/// The folder's name, as GitHub Classroom's tool gives it.
const SUBMISSIONS_SUFFIX: &str = "-submissions";
/// What classroom50's tool lays beside the repositories: a line for each student and attempt.
pub const CLASSROOM50_SCORES: &str = "scores.csv";
/// What its repositories hold beside the work.
const CLASSROOM50_RESULT: &str = "result.json";

/// What all repositories begin with. None if this is no such folder.
pub(super) fn prefix(root: &Node) -> Option<String> {
    if let Some(assignment) = root.name.strip_suffix(SUBMISSIONS_SUFFIX) {
        return Some(format!("{assignment}-"));
    }
    let folders = || root.children().iter().filter(|node| node.is_folder());
    let is_classroom50 = root.find(CLASSROOM50_SCORES).is_some()
        || (folders().count() > 0 && folders().all(|node| node.find(CLASSROOM50_RESULT).is_some()));
    is_classroom50.then(|| common_prefix(folders().map(|node| node.name.as_str())))
}

/// Up to the last `-` that all names share. Accounts may have `-` in them, and one account alone
/// can not be told from the assignment: its whole name is kept.
fn common_prefix<'a>(mut names: impl Iterator<Item = &'a str>) -> String {
    let Some(first) = names.next() else {
        return String::new();
    };
    let mut shared = first;
    let mut count = 1;
    for name in names {
        let same = |(mine, theirs): &((usize, char), char)| mine.1 == *theirs;
        let length = shared.char_indices().zip(name.chars()).take_while(same);
        let end = length.last().map_or(0, |((at, c), _)| at + c.len_utf8());
        shared = &shared[..end];
        count += 1;
    }
    match (count, shared.rfind('-')) {
        (2.., Some(end)) => shared[..=end].to_owned(),
        (_, _) => String::new(),
    }
}

pub(super) fn read(root: &Node) -> LayoutContents {
    let prefix = prefix(root).unwrap_or_default();
    let (mut entries, mut others) = (Vec::new(), Vec::new());
    for node in root.children() {
        if node.is_folder() {
            let login = node.name.strip_prefix(&prefix).unwrap_or(&node.name);
            entries.push(Entry {
                id: login.to_owned(),
                info: EntryInfo {
                    people: vec![Person {
                        login: login.to_owned(),
                        ..Person::default()
                    }],
                    from: node.name.clone(),
                    ..EntryInfo::default()
                },
                source: Source::Path(node.path.clone()),
            });
        } else if node.name != CLASSROOM50_SCORES {
            others.push(unmatched_path(node, "it is no repository"));
        }
    }
    (entries, others)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_common_prefix_of_repositories() {
        let names = [
            "cg-pathtracing-ann",
            "cg-pathtracing-ann-lee",
            "cg-pathtracing-bob",
        ];
        assert_eq!(common_prefix(names.into_iter()), "cg-pathtracing-");
        assert_eq!(common_prefix(names[..1].iter().copied()), "");
    }
}
