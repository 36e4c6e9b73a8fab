//! The description of an output format. Each format's file declares its [`FormatSpec`].

use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use judging::assignment::Task;

use crate::format::{FORMATS, StudentView};
use crate::report::text::HintDetail;

/// An output format, named after the platform that reads it.
pub struct FormatSpec {
    /// The name on the command line.
    pub id: &'static str,
    /// The default file name.
    pub file: &'static str,
    /// The environment variables whose values are copied into the file. All of them must be set.
    pub variables: &'static [&'static str],
    /// The environment variable that contains the path of a file to which several commands on the
    /// platform append. If the variable is set, the text is appended to that file unless a
    /// different path is requested.
    pub shared_file: Option<&'static str>,
    /// Renders the file. `None` for the score file, which isn't for students.
    pub render: Option<Render>,
    /// Renders commands for the CI runner, which are printed to standard output.
    pub runner_commands: Option<Render>,
}

/// A function that renders a format. It only receives what students may see.
pub type Render = fn(&StudentView, &FormatContext) -> String;

/// Facts about a submission that aren't part of its score.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FormatContext {
    /// The folder of the task files in the repository, such as `student/src`. It is empty if they
    /// are at the top level.
    pub folder: String,
    /// The location of each task's method.
    pub methods: BTreeMap<Task, MethodLocation>,
    /// The environment variables the platform uses to describe the submission.
    pub variables: BTreeMap<&'static str, String>,
    /// The level of detail of hints.
    pub hints: HintDetail,
}

/// The location of a method that students write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodLocation {
    /// The name of the task file, such as `sphere.rs`.
    pub file: &'static str,
    /// The 1-based line number of the method's signature, if the file contains it.
    pub line: Option<u32>,
}

impl FormatContext {
    /// Returns the name of the file that contains a task's method. The name is empty if the task
    /// isn't part of the assignment.
    pub fn file_of(&self, task: Task) -> &str {
        self.methods.get(&task).map_or("", |method| method.file)
    }
}

/// A format and an optional path, such as `gradescope` or `github=summary.md`.
#[derive(Clone, Debug)]
pub struct OutputSpec {
    /// The format.
    pub format: &'static FormatSpec,
    /// The file to write, or `None` for the format's default file.
    pub path: Option<PathBuf>,
}

impl FormatSpec {
    /// A format whose values are all empty, on which the definitions of the actual formats are
    /// based.
    pub const EMPTY: FormatSpec = FormatSpec {
        id: "",
        file: "",
        variables: &[],
        shared_file: None,
        render: None,
        runner_commands: None,
    };
}

impl fmt::Debug for FormatSpec {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.id)
    }
}

impl FromStr for OutputSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, path) = match text.split_once('=') {
            Some((name, path)) => (name, Some(PathBuf::from(path))),
            None => (text, None),
        };
        let format = FORMATS.into_iter().find(|format| format.id == name);
        let format = format.ok_or_else(|| {
            let known = FORMATS.map(|format| format.id).join(", ");
            format!("the formats are {known}; append =PATH to choose the file")
        })?;
        match path {
            Some(path) if format.render.is_none() || path.as_os_str().is_empty() => {
                Err("expected a path after `=`; score.json always goes to --out".to_owned())
            }
            path => Ok(OutputSpec { format, path }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::tests::sample;

    #[test]
    fn a_format_is_named_with_or_without_a_path() {
        let parsed = |text: &str| {
            let spec: OutputSpec = text.parse().unwrap();
            (format!("{:?}", spec.format), spec.path)
        };
        assert_eq!(parsed("junit"), ("junit".to_owned(), None));
        assert_eq!(parsed("json"), ("json".to_owned(), None));
        let path = Some(PathBuf::from("a=b.md"));
        assert_eq!(parsed("github=a=b.md"), ("github".to_owned(), path));
    }

    #[test]
    fn only_a_format_with_a_file_of_its_own_takes_a_path() {
        let error = |text: &str| text.parse::<OutputSpec>().unwrap_err();
        let no_path = "expected a path after `=`; score.json always goes to --out";
        assert_eq!(error("json=score.json"), no_path);
        assert_eq!(error("junit="), no_path);
        let unknown = error("gradescop");
        assert!(unknown.starts_with("the formats are json, text, html, gradescope,"));
    }

    #[test]
    fn the_file_of_a_task_of_another_assignment_is_unknown() {
        let context = sample::context();
        let file_of = |id| context.file_of(Task::in_id(id).unwrap());
        assert_eq!(["traverse.x", "other.x"].map(file_of), ["bvh.rs", ""]);
    }
}
