//! The paths of the task files on this machine, so that an editor can jump to the lines in a
//! report.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use crate::handed_out::HandedOut;
use crate::workspace::display_path;

/// The folder of a submission's task files, if they are where the assignment expects them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourcePaths {
    folder: Option<PathBuf>,
    handed_out: &'static HandedOut,
}

impl SourcePaths {
    /// Finds the folder of a submission's task files. If several folders contain task files, it is
    /// the one with the most, as in [`Submission::collect`](crate::submission::Submission::collect).
    pub fn of(submission: &Path, handed_out: &'static HandedOut) -> Self {
        let below = handed_out.folders_in(submission).first().copied();
        SourcePaths {
            folder: below.map(|below| submission.join(below).components().collect()),
            handed_out,
        }
    }

    /// Returns the folder, if it was found.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Returns the text with the path added to each mention of a task file with a line number:
    /// `sphere.rs:7` becomes `student/src/sphere.rs:7`.
    pub fn in_text<'a>(&self, text: &'a str) -> Cow<'a, str> {
        let Some(folder) = &self.folder else {
            return Cow::Borrowed(text);
        };
        let mut text = Cow::Borrowed(text);
        for name in self.handed_out.file_names() {
            let mention = format!("{name}:");
            if text.contains(&mention) {
                let path = display_path(&folder.join(name));
                text = Cow::Owned(with_path(&text, &mention, &path));
            }
        }
        text
    }
}

/// Replaces the name in each `mention`, such as `sphere.rs:`, that precedes a line number and isn't
/// already part of a path.
fn with_path(text: &str, mention: &str, path: &str) -> String {
    let mut replaced = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(mention) {
        let (before, after) = (&rest[..start], &rest[start + mention.len()..]);
        let is_part = |c: char| c.is_alphanumeric() || "_-./\\".contains(c);
        replaced.push_str(before);
        if after.starts_with(|c: char| c.is_ascii_digit()) && !before.ends_with(is_part) {
            replaced.push_str(path);
            replaced.push(':');
        } else {
            replaced.push_str(mention);
        }
        rest = after;
    }
    replaced + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handed_out::RAYS;

    #[test]
    fn names_the_path_of_each_line_in_a_task_file() {
        let folder = tempfile::TempDir::new().unwrap();
        std::fs::create_dir(folder.path().join("src")).unwrap();
        let sphere = folder.path().join("src").join("sphere.rs");
        std::fs::write(&sphere, "").unwrap();
        let paths = SourcePaths::of(folder.path(), &RAYS);
        let sphere = display_path(&sphere);
        let text = " --> sphere.rs:7:3, hemisphere.rs:1, src/sphere.rs:2, sphere.rs: none";
        assert_eq!(
            paths.in_text(text),
            text.replace("> sphere.rs:7", &format!("> {sphere}:7"))
        );
        let archive = SourcePaths::of(&folder.path().join("a.zip"), &RAYS);
        assert_eq!(archive.in_text(text), text);

        // A stray file in another folder doesn't change where the others are.
        std::fs::write(folder.path().join("camera.rs"), "").unwrap();
        std::fs::write(folder.path().join("src/camera.rs"), "").unwrap();
        assert_eq!(SourcePaths::of(folder.path(), &RAYS), paths);
    }
}
