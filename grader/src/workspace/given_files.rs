//! Checks whether the given code that is compiled into the grader itself is unmodified.
//!
//! The grader replaces other given files with its own, but not these. If a student changes one,
//! e.g. to print something, their own results come from the changed code, while the real grading
//! uses the original.

use std::collections::BTreeMap;
use std::path::Path;

use judging::content_hash::file_hash;

use crate::machine::files;

/// The file in a bundle that lists these given files and their hashes. It doesn't exist in this
/// repository.
pub const LIST: &str = "grader/given-files.txt";

/// The folders that contain the listed files.
const FOLDERS: [&str; 2] = ["student/framework/", "student/protocol/"];
/// The maximum number of files to name in a note.
const MAX_NAMES: usize = 3;

/// Returns the text of the list. `bundle` contains the contents of all files in a bundle, keyed by
/// path.
pub fn list(bundle: &BTreeMap<String, Vec<u8>>) -> String {
    let files = bundle.iter();
    let given = files.filter(|(path, _)| FOLDERS.iter().any(|folder| path.starts_with(folder)));
    given
        .map(|(path, contents)| format!("{}  {path}\n", hash(contents)))
        .collect()
}

/// Returns a note if files in the workspace at `root` differ from the list. A missing file needs no
/// note, because the code doesn't compile without it.
pub fn changed(root: &Path) -> Option<String> {
    let list = files::read_to_string(root.join(LIST)).ok()?;
    let listed = list.lines().filter_map(|line| line.split_once("  "));
    let is_changed = |(expected, path): &(&str, &str)| {
        let contents = files::read(root.join(path));
        contents.is_ok_and(|contents| hash(&contents) != *expected)
    };
    let changed: Vec<&str> = listed.filter(is_changed).map(|(_, path)| path).collect();
    note(&changed)
}

fn note(changed: &[&str]) -> Option<String> {
    let (first, others) = changed.split_at(changed.len().min(MAX_NAMES));
    let more = match others.len() {
        0 => String::new(),
        count => format!(" and {count} more"),
    };
    (!first.is_empty()).then(|| {
        format!(
            "the given code was changed: {}{more}. These results are for the changed code, but \
             your work will be graded with the original. Undo the changes, or extract these files \
             from the archive again and run `cargo clean`, because Cargo doesn't notice changed \
             files with old dates",
            first.join(", ")
        )
    })
}

/// Returns the hash of a file, ignoring the style of line endings, because Git and editors change
/// it.
fn hash(contents: &[u8]) -> String {
    let mut contents = contents.to_owned();
    contents.retain(|byte| *byte != b'\r');
    file_hash(&contents)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bundle<const N: usize>(files: [(&str, &str); N]) -> BTreeMap<String, Vec<u8>> {
        let files = files.into_iter();
        files
            .map(|(path, text)| (path.to_owned(), text.as_bytes().to_owned()))
            .collect()
    }

    #[test]
    fn the_list_has_the_code_in_the_given_folders() {
        let files = bundle([
            ("student/protocol/src/interval.rs", "abc"),
            ("student/src/bvh.rs", "abc"),
            ("student/framework/src/lib.rs", "abc"),
        ]);
        let expected = "\
            ba80a53f981c4d0d6a2797b69f12f6e9  student/framework/src/lib.rs\n\
            ba80a53f981c4d0d6a2797b69f12f6e9  student/protocol/src/interval.rs\n";
        assert_eq!(list(&files), expected);
    }

    #[test]
    fn a_changed_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let write = |path: &str, text: &str| {
            files::write_with_parents(folder.path().join(path), text).unwrap();
        };
        let paths = ["student/protocol/src/a.rs", "student/framework/src/b.rs"];
        assert_eq!(changed(folder.path()), None, "without a list");
        write(LIST, &list(&bundle(paths.map(|path| (path, "1\n")))));
        for path in paths {
            write(path, "1\r\n");
        }
        assert_eq!(changed(folder.path()), None);
        write(paths[1], "2\n");
        let named = changed(folder.path()).unwrap();
        assert!(
            named.contains(paths[1]) && !named.contains(paths[0]),
            "{named}"
        );
        let many = note(&["a.rs", "b.rs", "c.rs", "d.rs", "e.rs"]).unwrap();
        assert!(many.starts_with("the given code was changed: a.rs, b.rs, c.rs and 2 more. "));
    }
}
