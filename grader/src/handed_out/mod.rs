//! The files of an assignment as handed out, embedded in this program: the task files that students
//! write and the given files around them. Given files in a submission are compared with these but
//! never used.

mod fresh;
mod light;
mod method_span;
mod own_lines;
mod rays;
mod tokens;

use std::cmp::Reverse;
use std::fmt;
use std::path::Path;

use judging::assignment::{Assignment, TaskInfo};

use method_span::{MethodSpan, methods};
use tokens::{contains, tokens};

pub use fresh::{ChangedDeclaration, MethodPosition, TaskMethods, changed_declaration};
pub use judging::assignment::TaskFile;
pub use light::LIGHT;
pub use method_span::find_method;
pub use own_lines::own_lines;
pub use rays::RAYS;
pub use tokens::without_comments;

/// The assignments that can be selected with `--assignment`. The first is the default.
pub static ASSIGNMENTS: [&HandedOut; 2] = [&RAYS, &LIGHT];

/// An assignment as handed out to students.
#[derive(PartialEq, Eq)]
pub struct HandedOut {
    /// The assignment's tasks.
    pub assignment: &'static Assignment,
    /// The practice exam, as JSON.
    pub practice_exam: &'static str,
    /// The files that students write, in lecture order.
    pub files: &'static [TaskFile],
    /// The given files that are compiled with every submission. The first is the crate's root.
    pub given: &'static [GivenFile],
    /// The given file that renders pictures. The grader doesn't use it.
    pub main: GivenFile,
    /// Source of a probe's `main` function, which is appended to the crate's root. If it is empty,
    /// the files are compiled as a library named like the assignment.
    pub entry: &'static str,
    /// The folder where students do their own work, relative to the workspace.
    pub student: &'static str,
    /// The starter's folder, relative to the workspace. The starter's files are embedded in this
    /// program.
    pub starter: &'static str,
    /// The folder with the reference solution's files, relative to the workspace. Students don't
    /// have it.
    pub reference: &'static str,
    /// The files that can be graded with the reference's parts.
    pub substitutions: &'static [SubstitutedFile],
}

/// A file that students are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GivenFile {
    /// The file name, such as `world.rs`.
    pub name: &'static str,
    /// The file's text.
    pub text: &'static str,
}

/// A task file that is graded with the reference's parts in place of the submission's other files
/// if an item it depends on has failed. The sources that connect it to the parts are in
/// [`SubstitutedFile::folder`].
#[derive(Debug, PartialEq, Eq)]
pub struct SubstitutedFile {
    /// The name of the task file.
    pub file: &'static str,
    /// The given files that are compiled with the file.
    pub given: &'static [&'static str],
    /// The other files that use the file. The file is graded without them.
    pub users: &'static [&'static str],
}

impl SubstitutedFile {
    /// Returns the folder with the sources that connect the file to the parts. The path is relative
    /// to the parent of the reference's `src`.
    pub fn folder(&self) -> String {
        format!("substitution/{}", self.file.trim_end_matches(".rs"))
    }
}

/// Returns whether the text of a task file is the same as the starter's, token for token.
pub fn is_unwritten(file: &TaskFile, text: &str) -> bool {
    tokens(text) == tokens(file.starter)
}

/// Returns the methods in the starter's file.
fn starter_methods(file: &TaskFile) -> Vec<MethodSpan<'static>> {
    methods(file.starter).expect("the starter's braces match")
}

impl Default for &'static HandedOut {
    /// Returns the assignment to use when the command line doesn't name one.
    fn default() -> Self {
        ASSIGNMENTS[0]
    }
}

impl HandedOut {
    /// Returns the assignment with this id.
    ///
    /// # Errors
    ///
    /// A message for the command line if there is no such assignment.
    pub fn find(id: &str) -> Result<&'static HandedOut, String> {
        let found = ASSIGNMENTS.into_iter().find(|it| it.assignment.id == id);
        found.ok_or_else(|| {
            let ids = ASSIGNMENTS.map(|it| it.assignment.id).join(", ");
            format!("unknown assignment; the assignments are {ids}")
        })
    }

    /// Returns the folder with the assignment's solutions, which is the parent of the reference's
    /// `src`. The path is relative to the workspace.
    pub fn solutions(&self) -> &'static str {
        self.reference.trim_end_matches("/src")
    }

    /// Returns the names of the reference files that are used as the parts when a file is
    /// substituted: all files except the crate's root, the files that are compiled with the
    /// submission, and the files that use the substituted file.
    pub fn parts(&self, substituted: &SubstitutedFile) -> impl Iterator<Item = &'static str> {
        let given = self.given.iter().skip(1).map(|file| file.name);
        let all = self.file_names().chain(given);
        let SubstitutedFile { file, given, users } = substituted;
        all.filter(move |name| name != file && !given.contains(name) && !users.contains(name))
    }

    /// Returns the task file with exactly this name. A similar name, such as `Bvh.rs`, is a
    /// different file.
    pub fn task_file(&self, name: &str) -> Option<&'static TaskFile> {
        self.files.iter().find(|file| file.name == name)
    }

    /// Returns the given file with this name.
    pub fn given_file(&self, name: &str) -> Option<&GivenFile> {
        let mut given = self.given.iter().chain([&self.main]);
        given.find(|file| file.name == name)
    }

    /// Returns the names of the task files, in lecture order.
    pub fn file_names(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.files.iter().map(|file| file.name)
    }

    /// Returns the names of the task files as a list for use in a sentence, such as `a.rs, b.rs and
    /// c.rs`.
    pub fn file_list(&self) -> String {
        let names: Vec<&str> = self.file_names().collect();
        match names.split_last() {
            Some((last, [])) => (*last).to_owned(),
            Some((last, others)) => format!("{} and {last}", others.join(", ")),
            None => String::new(),
        }
    }

    /// Returns the folders where the assignment expects task files, without those that contain
    /// none. The folder with the most files comes first. The paths are relative to the submission's
    /// folder.
    pub fn folders_in(&self, submission: &Path) -> Vec<&'static str> {
        let count = |below: &str| {
            let folder = submission.join(below);
            let names = self.file_names();
            names
                .filter(|name| folder.join(name).symlink_metadata().is_ok())
                .count()
        };
        let folders = self.assignment.folders.iter().copied();
        let counted = folders.map(|below| (count(below), below));
        let mut found: Vec<(usize, &str)> = counted.filter(|(count, _)| *count > 0).collect();
        found.sort_by_key(|(count, _)| Reverse(*count));
        found.into_iter().map(|(_, below)| below).collect()
    }

    /// Returns the given methods of a task file that are missing from `text` or differ there from
    /// the starter's versions. A note in the report lists these methods.
    pub fn changed_methods(&self, file: &TaskFile, text: &str) -> Vec<ChangedMethod> {
        let text = tokens(text);
        let is_to_write =
            |task: &TaskInfo, path: &str| task.file == file.name && task.methods.contains(&path);
        let given = starter_methods(file).into_iter().filter(|method| {
            let mut tasks = self.assignment.tasks.iter();
            let path = method.path();
            !tasks.any(|task| is_to_write(task, &path))
        });
        let changed = given.filter(|method| {
            let method = &file.starter[method.bytes.clone()];
            !contains(&text, &tokens(method))
        });
        let changed = changed.map(|MethodSpan { name, .. }| ChangedMethod {
            name,
            is_missing: !contains(&text, &["fn", name]),
        });
        changed.collect()
    }
}

/// A given method that a submission has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChangedMethod {
    /// The method's name.
    pub name: &'static str,
    /// Whether the method no longer exists.
    pub is_missing: bool,
}

impl fmt::Debug for HandedOut {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.assignment.id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn task_file(name: &str) -> &'static TaskFile {
        RAYS.task_file(name).unwrap()
    }

    #[test]
    fn finds_the_methods_of_a_file() {
        let names = |file| -> Vec<&str> {
            let methods = starter_methods(task_file(file));
            methods.iter().map(|method| method.name).collect()
        };
        assert_eq!(names("camera.rs"), ["new", "sample_ray"]);
        assert_eq!(names("sphere.rs"), ["new", "bbox", "uv", "hit"]);
    }

    #[test]
    fn reports_a_changed_given_method_but_not_a_stub() {
        let sphere = task_file("sphere.rs");
        let changed = |text: &str| {
            let changed = RAYS.changed_methods(sphere, text).into_iter();
            let changed = changed.map(|method| (method.name, method.is_missing));
            changed.collect::<Vec<_>>()
        };
        for (was, now, expected) in [
            ("    ", "  ", &[][..]),
            ("todo!", "panic!", &[]),
            ("/ PI", "/ 3.0", &[("uv", false)]),
            ("fn uv(", "fn uv_of(", &[("uv", true)]),
        ] {
            assert_eq!(
                changed(&sphere.starter.replace(was, now)),
                expected,
                "{now}"
            );
        }
    }

    #[test]
    fn recognises_the_starter_after_formatting_but_not_after_a_change() {
        let sphere = task_file("sphere.rs");
        assert!(is_unwritten(
            sphere,
            &sphere.starter.replace("todo!", "// Later.\n        todo!")
        ));
        assert!(is_unwritten(sphere, &sphere.starter.replace('\n', "\r\n")));
        assert!(!is_unwritten(
            sphere,
            &sphere.starter.replace("todo!", "panic!")
        ));
    }

    #[test]
    fn starter_has_every_required_declaration() {
        for file in RAYS.files {
            let mut required = file.required_declarations.iter();
            let missing = required.find(|part| !file.starter.contains(**part));
            assert_eq!(missing, None, "{}", file.name);
        }
        // Each task must be in a task file.
        for task in RAYS.assignment.tasks {
            assert!(RAYS.task_file(task.file).is_some(), "{}", task.id);
        }
    }
}
