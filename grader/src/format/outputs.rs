//! Writes the output files. This is the only module of [`format`](crate::format) that accesses
//! files and the environment.

use std::collections::BTreeMap;
use std::env;
use std::path::{Path, PathBuf};

use judging::assignment::{Task, TaskInfo};
use judging::sanitize::sanitize_line;

use crate::files::{self, PathError};
use crate::format::{FormatContext, FormatSpec, MethodLocation, OutputSpec, StudentView};
use crate::handed_out::HandedOut;
use crate::report::atomic_write;
use crate::report::text::HintDetail;
use crate::submission::Submission;

/// Reasons why an output file cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// An environment variable that the format needs is missing.
    #[error(
        "--format {format} needs the environment variable {variable}, which is not set: grade on the platform's runner, or set {all}"
    )]
    MissingVariable {
        /// The name of the format.
        format: &'static str,
        /// The name of the missing variable.
        variable: &'static str,
        /// The names of all variables that the format needs.
        all: String,
    },
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] PathError),
}

/// The requested output files, and the context to render them.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    files: Vec<Output>,
    context: FormatContext,
}

/// The output file of one format.
#[derive(Clone, Debug)]
struct Output {
    format: &'static FormatSpec,
    path: PathBuf,
    /// Text that other commands wrote to the file earlier. The output is appended to it.
    existing_text: String,
}

impl Outputs {
    /// Resolves the path of each requested output: the path in the request if there is one, else
    /// the platform's, else a file in `folder`. Fails if the environment lacks a variable that a
    /// format needs.
    pub fn new(
        specs: &[OutputSpec],
        folder: &Path,
        submitted: &Path,
        submission: &Submission,
        hints: HintDetail,
    ) -> Result<Self, OutputError> {
        let mut outputs = Outputs {
            files: Vec::new(),
            context: FormatContext {
                folder: folder_in_checkout(submitted, submission.handed_out),
                methods: find_methods(submission),
                variables: BTreeMap::new(),
                hints,
            },
        };
        for spec in specs {
            read_variables(spec.format, &mut outputs.context.variables)?;
            outputs.files.push(resolve_output(spec, folder)?);
        }
        Ok(outputs)
    }

    /// Writes each file atomically. `view` is called only if there are files to write.
    pub fn write(&self, view: &dyn Fn() -> StudentView) -> Result<(), OutputError> {
        if self.is_empty() {
            return Ok(());
        }
        let view = &view();
        for Output {
            format,
            path,
            existing_text,
        } in &self.files
        {
            let Some(render) = format.render else {
                continue;
            };
            let text = format!("{existing_text}{}", render(view, &self.context));
            atomic_write::write(&text, path)?;
        }
        Ok(())
    }

    /// Returns the commands that the requested formats print for the CI runner.
    pub fn runner_commands(&self, view: &StudentView) -> String {
        let files = self.files.iter();
        let commands = files.filter_map(|output| output.format.runner_commands);
        commands.map(|render| render(view, &self.context)).collect()
    }

    /// Returns whether no output was requested.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// Returns the paths of the requested files, except the score file.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        let files = self.files.iter();
        let rendered = files.filter(|output| output.format.render.is_some());
        rendered.map(|output| output.path.as_path())
    }
}

fn resolve_output(spec: &OutputSpec, folder: &Path) -> Result<Output, OutputError> {
    let format = spec.format;
    let shared = format.shared_file.and_then(env::var_os);
    let shared = shared.filter(|path| !path.is_empty()).map(PathBuf::from);
    let (path, existing_text) = match (&spec.path, shared) {
        (Some(path), _) => (path.clone(), String::new()),
        (None, None) => (folder.join(format.file), String::new()),
        (None, Some(path)) => {
            let existing_text = files::read_if_exists(&path)?.unwrap_or_default();
            (path, existing_text)
        }
    };
    Ok(Output {
        format,
        path,
        existing_text,
    })
}

/// Reads the environment variables that a format needs. Fails if one is missing.
fn read_variables(
    format: &FormatSpec,
    known: &mut BTreeMap<&'static str, String>,
) -> Result<(), OutputError> {
    for variable in format.variables {
        let value = env::var(variable).ok().filter(|value| !value.is_empty());
        let value = value.ok_or_else(|| OutputError::MissingVariable {
            format: format.id,
            variable,
            all: format.variables.join(", "),
        })?;
        known.insert(variable, value);
    }
    Ok(())
}

/// Returns the folder of the task files relative to the checkout, which is `GITHUB_WORKSPACE` or
/// the current folder. The result is empty if the files are not below the checkout.
fn folder_in_checkout(submitted: &Path, handed_out: &HandedOut) -> String {
    let current = env::current_dir().unwrap_or_default();
    let submitted = current.join(submitted);
    let checkout = env::var_os("GITHUB_WORKSPACE").map_or(current, PathBuf::from);
    let folders = handed_out.assignment.folders.iter();
    let mut folders = folders.map(|folder| submitted.join(folder));
    let has_task_files = |folder: &PathBuf| {
        let mut files = handed_out.files.iter();
        files.any(|file| folder.join(file.name).symlink_metadata().is_ok())
    };
    let folder = folders.find(has_task_files);
    let folder = folder.and_then(|folder| folder.canonicalize().ok());
    let relative = folder.and_then(|folder| {
        let relative = folder.strip_prefix(checkout.canonicalize().ok()?).ok()?;
        let relative = relative.to_string_lossy().replace('\\', "/");
        Some(sanitize_line(&relative, usize::MAX))
    });
    relative.unwrap_or_default()
}

/// Finds the method of each task in the submission's files.
fn find_methods(submission: &Submission) -> BTreeMap<Task, MethodLocation> {
    let line = |task: &TaskInfo| {
        let mut files = submission.files.iter();
        let (_, text) = files.find(|(file, _)| file.name == task.file)?;
        let head = format!("pub fn {}(", task.method);
        let mut lines = (1..).zip(text.as_ref().ok()?.lines());
        let (line, _) = lines.find(|(_, line)| line.trim_start().starts_with(&head))?;
        Some(line)
    };
    let location = |task: &TaskInfo| {
        let (file, line) = (task.file, line(task));
        (task.task(), MethodLocation { file, line })
    };
    let tasks = submission.handed_out.assignment.tasks.iter();
    tasks.map(location).collect()
}
