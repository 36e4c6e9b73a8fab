//! Clones from GitHub Classroom or classroom50: repositories named after the assignment and the
//! account. GitHub Classroom puts them into a folder `ASSIGNMENT-submissions`; classroom50 writes
//! `scores.csv` beside them.

use super::{LayoutContents, unmatched_path};
use crate::entry::{Entry, Person, Source};
use crate::listing::Node;

/// The suffix of the folder that GitHub Classroom's tool creates.
const SUBMISSIONS_SUFFIX: &str = "-submissions";
/// The name of the file that classroom50's tool writes beside the repositories. It has a row for
/// each attempt of each student.
pub const CLASSROOM50_SCORES: &str = "scores.csv";
/// The name of a file that every repository of classroom50 contains.
const CLASSROOM50_RESULT: &str = "result.json";

/// Returns the common prefix of the repositories' names, or `None` if the folder has another
/// layout.
pub(super) fn prefix(root: &Node) -> Option<String> {
    if let Some(assignment) = root.name.strip_suffix(SUBMISSIONS_SUFFIX) {
        return Some(format!("{assignment}-"));
    }
    let is_clone = |node: &&Node| node.is_folder() && !node.is_link;
    let folders = || root.children().iter().filter(is_clone);
    let prefix = common_prefix(folders().map(|node| node.name.as_str()));
    let has_results = || folders().all(|node| node.find(CLASSROOM50_RESULT).is_some());
    // A student can add this file, but not make all folders begin alike.
    let is_classroom50 =
        root.find(CLASSROOM50_SCORES).is_some() || (!prefix.is_empty() && has_results());
    is_classroom50.then_some(prefix)
}

/// Returns the common prefix of all names, cut off after its last `-`, since the account names may
/// begin with the same letters as well. For a single name, the prefix is empty, since nothing shows
/// where the account name begins.
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
            let person = Person {
                login: login.to_owned(),
                ..Person::default()
            };
            let source = Source::Path(node.path.clone());
            entries.push(Entry::new(login, person, &node.name, source));
        } else if node.name != CLASSROOM50_SCORES {
            others.push(unmatched_path(node, "it is not a repository"));
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
