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
fn common_prefix<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    let [first, others @ ..] = names.as_slice() else {
        return String::new();
    };
    let is_shared = |end: &usize| others.iter().all(|name| name.starts_with(&first[..*end]));
    let ends = first.rmatch_indices('-').map(|(at, _)| at + 1);
    let end = ends.filter(|_| !others.is_empty()).find(is_shared);
    first[..end.unwrap_or(0)].to_owned()
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
