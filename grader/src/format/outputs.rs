//! Where the formats go: the only part of this folder that touches the machine.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::exam::Task;
use crate::format::github::annotations;
use crate::format::{Format, FormatContext, OutputSpec, StudentView};
use crate::given_files::TASK_FILES;
use crate::report::atomic_write;
use crate::submission::Submission;

/// The places of the five files in a checkout, as a submission is collected.
const TASK_FILE_FOLDERS: [&str; 3] = ["", "src", "student/src"];

/// Why a format can not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The platform has not said whose work it is.
    #[error(
        "--format {format} repeats what its runner says in {variable}, which is not set: run it there, or set all of {all}"
    )]
    MissingVariable {
        /// The format.
        format: &'static str,
        /// What is missing.
        variable: &'static str,
        /// What there must be.
        all: String,
    },
    /// A file can not be read or written.
    #[error("can not write {}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

/// The files that were asked for, and what is told in them of the surroundings.
#[derive(Clone, Debug, Default)]
pub struct Outputs {
    files: Vec<Output>,
    context: FormatContext,
}

/// One format's file.
#[derive(Clone, Debug)]
struct Output {
    format: Format,
    path: PathBuf,
    /// What others have written there before us, which stays.
    existing_text: String,
}

impl Outputs {
    /// Those that the command line names, in `folder` unless a platform or `PATH` says otherwise.
    pub fn new(
        wanted: &[OutputSpec],
        folder: &Path,
        submitted: &Path,
        submission: &Submission,
        full_hints: bool,
    ) -> Result<Self, OutputError> {
        let mut outputs = Outputs {
            files: Vec::new(),
            context: FormatContext {
                folder: folder_in_checkout(submitted),
                method_lines: find_method_lines(submission),
                variables: BTreeMap::new(),
                full_hints,
            },
        };
        for wanted in wanted {
            read_variables(wanted.format, &mut outputs.context.variables)?;
            outputs.files.push(resolve_output(wanted, folder)?);
        }
        Ok(outputs)
    }

    /// Writes each file whole. What may be seen is only asked for where there are any.
    pub fn write(&self, seen: &dyn Fn() -> StudentView) -> Result<(), OutputError> {
        if self.is_empty() {
            return Ok(());
        }
        let seen = &seen();
        for Output {
            format,
            path,
            existing_text: before,
        } in &self.files
        {
            let Some(text) = format.render(seen, &self.context) else {
                continue;
            };
            let text = format!("{before}{text}");
            atomic_write::write(&text, path).map_err(|source| OutputError::Io {
                path: path.clone(),
                source,
            })?;
        }
        Ok(())
    }

    /// What the runner is to be told on standard output.
    pub fn runner_commands(&self, seen: &StudentView) -> Option<String> {
        let mut files = self.files.iter();
        let is_wanted = files.any(|output| output.format == Format::Github);
        is_wanted.then(|| annotations(seen, &self.context))
    }

    /// Whether nothing was asked for.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// The files that were asked for, but for the score file.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        let files = self.files.iter();
        let others = files.filter(|output| output.format != Format::Json);
        others.map(|output| output.path.as_path())
    }
}

fn resolve_output(wanted: &OutputSpec, folder: &Path) -> Result<Output, OutputError> {
    let format = wanted.format;
    // A step's own files: others of the step may have written there already.
    let shared = match format {
        Format::Github => env::var_os("GITHUB_STEP_SUMMARY"),
        Format::GithubClassroom => env::var_os("GITHUB_OUTPUT"),
        Format::Json
        | Format::Text
        | Format::Html
        | Format::Gradescope
        | Format::Classroom50
        | Format::Junit
        | Format::Check50
        | Format::Prairielearn => None,
    };
    let shared = shared.filter(|path| !path.is_empty()).map(PathBuf::from);
    let (path, before) = match (&wanted.path, shared) {
        (Some(path), _) => (path.clone(), String::new()),
        (None, None) => (folder.join(format.file()), String::new()),
        (None, Some(path)) => match fs::read_to_string(&path) {
            Ok(before) => (path, before),
            Err(error) if error.kind() == io::ErrorKind::NotFound => (path, String::new()),
            Err(source) => return Err(OutputError::Io { path, source }),
        },
    };
    Ok(Output {
        format,
        path,
        existing_text: before,
    })
}

/// Notes what the platform says, all of which a format needs.
fn read_variables(
    format: Format,
    known: &mut BTreeMap<&'static str, String>,
) -> Result<(), OutputError> {
    for variable in format.variables() {
        let value = env::var(variable).ok().filter(|value| !value.is_empty());
        let value = value.ok_or_else(|| OutputError::MissingVariable {
            format: format.id(),
            variable,
            all: format.variables().join(", "),
        })?;
        known.insert(variable, value);
    }
    Ok(())
}

/// The folder of the five files, from the checkout's, which is the current one unless the runner
/// says otherwise. Empty if they are not below it.
fn folder_in_checkout(submitted: &Path) -> String {
    let here = env::current_dir().unwrap_or_default();
    let submitted = here.join(submitted);
    let here = env::var_os("GITHUB_WORKSPACE").map_or(here, PathBuf::from);
    let places = TASK_FILE_FOLDERS.map(|place| submitted.join(place));
    let holds_some = |place: &PathBuf| {
        let mut files = TASK_FILES.iter();
        files.any(|file| place.join(file.name).symlink_metadata().is_ok())
    };
    let place = places.into_iter().find(holds_some);
    let place = place.and_then(|place| place.canonicalize().ok());
    let below = place.and_then(|place| {
        let below = place.strip_prefix(here.canonicalize().ok()?).ok()?;
        Some(below.to_string_lossy().replace('\\', "/"))
    });
    below.unwrap_or_default()
}

/// The line of each task's method, counted from 1.
fn find_method_lines(submission: &Submission) -> BTreeMap<Task, u32> {
    let line = |task: Task| {
        let mut files = submission.files.iter();
        let (_, text) = files.find(|(file, _)| file.name == task.file())?;
        let head = format!("pub fn {}(", task.method());
        let mut lines = (1..).zip(text.as_ref().ok()?.lines());
        let (line, _) = lines.find(|(_, line)| line.trim_start().starts_with(&head))?;
        Some((task, line))
    };
    Task::ALL.into_iter().filter_map(line).collect()
}
