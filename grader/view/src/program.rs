//! Builds a submission's two programs: one that draws, and one that records tests.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use grader::build::{Build, Builder, NotCompiled};
use grader::handed_out::{GivenFile, HandedOut};
use grader::sandbox::Sandbox;
use grader::select_isolation::{IsolationRequest, with_requested_level};
use grader::submission::{Submission, SubmissionError};
use grader::verdict::file_message;
use grader::workspace::Workspace;
use serde::Serialize;

use crate::error::ViewError;
use crate::recording::RECORDED;

/// The name and the folder of a package that is linked with the submission.
pub type Package = (&'static str, &'static str);

/// The package that answers the viewer's requests.
const PROBE: Package = ("view_probe", "grader/view/probe");
/// The student's code for part two, which draws the shaded view.
pub const LIGHT: Package = ("light", "student/light");
/// The reference's code for part two.
pub const REFERENCE_LIGHT: Package = ("reference-light", "reference/light");

/// Returns the `main` function of both programs.
fn entry(light: Package) -> String {
    let (name, _) = light;
    let name = name.replace('-', "_");
    format!(
        "
/// Answers the viewer's requests.
fn main() -> std::process::ExitCode {{
    view_probe::main(&world::Student, &{name}::integrator::Light)
}}
"
    )
}

/// The submission to view, and the compiler.
#[derive(Clone, Debug)]
pub struct Programs {
    builder: Builder,
    drawing: &'static HandedOut,
    recording: &'static HandedOut,
    folder: PathBuf,
    /// Whether the folder is a package, i.e. has its files in `src`.
    is_package: bool,
}

/// A program, or the reason there is none.
#[derive(Clone, Debug, Default)]
pub enum BuildState {
    /// The compiler is at work.
    #[default]
    Compiling,
    /// The program is ready.
    Ready(Program),
    /// The submission doesn't compile.
    Failed(Vec<FileError>),
    /// The compiler could not be run.
    Broken(String),
}

/// A compiled program. Its file is deleted when this is dropped.
#[derive(Clone, Debug)]
pub struct Program(Arc<Build>);

/// An error in one of the submission's files.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FileError {
    /// The name of the file.
    pub file: String,
    /// The line number, starting at 1.
    pub line: Option<u32>,
    /// The compiler's message.
    pub text: String,
}

impl Programs {
    /// Prepares the compiler, in a sandbox if `isolation` requires one. The package `light` draws the
    /// shaded view.
    pub fn prepare(
        workspace: &Workspace,
        handed_out: &'static HandedOut,
        folder: PathBuf,
        is_package: bool,
        light: Package,
        isolation: IsolationRequest,
    ) -> Result<Self, ViewError> {
        let builder = Builder::prepare_with_packages(&[PROBE, light], workspace);
        let builder = builder.map_err(ViewError::machine)?;
        Ok(Programs {
            builder: with_requested_level(builder, isolation).map_err(ViewError::machine)?,
            drawing: with_probe(handed_out, light, |file| *file),
            recording: with_probe(handed_out, light, with_recording),
            folder,
            is_package,
        })
    }

    /// Returns the assignment.
    pub fn handed_out(&self) -> &'static HandedOut {
        self.drawing
    }

    /// Returns the folder or archive of the submission.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Reads the current version of the submission's files.
    pub fn collect(&self) -> Result<Submission, SubmissionError> {
        if self.is_package {
            Submission::collect_package(&self.folder, self.drawing)
        } else {
            Submission::collect(&self.folder, self.drawing)
        }
    }

    /// Builds the program that records tests.
    pub fn build_recording(&self, submission: &Submission) -> BuildState {
        let mut changed = submission.clone();
        changed.handed_out = self.recording;
        for method in RECORDED {
            for (file, text) in &mut changed.files {
                if file.name == method.file
                    && let Ok(text) = text
                    && let Some(recorded) = method.apply(text)
                {
                    *text = recorded;
                }
            }
        }
        self.build(&changed, |_| {})
    }

    /// Builds the program that draws. Calls `report` with errors as soon as the compiler has found
    /// them.
    pub fn build(
        &self,
        submission: &Submission,
        mut report: impl FnMut(Vec<FileError>),
    ) -> BuildState {
        let built = self.builder.build_with_progress(submission, |files| {
            report(file_errors(files.iter().map(|(file, why)| (*file, why))));
        });
        let build = match built {
            Ok(build) => build,
            Err(error) => return BuildState::Broken(error.to_string()),
        };
        let errors = file_errors(build.not_compiled.iter().map(|(file, why)| (*file, why)));
        if errors.is_empty() && build.probe.is_some() {
            BuildState::Ready(Program(Arc::new(build)))
        } else {
            BuildState::Failed(errors)
        }
    }
}

impl Program {
    /// Returns the path of the program and the sandbox to start it in.
    pub fn executable(&self) -> (PathBuf, Sandbox) {
        let Program(build) = self;
        let launcher = build.launcher(&build.probe.clone().unwrap_or_default());
        (launcher.program, launcher.sandbox)
    }
}

fn file_errors<'a>(files: impl Iterator<Item = (&'static str, &'a NotCompiled)>) -> Vec<FileError> {
    let error = |(file, why): (&'static str, &NotCompiled)| FileError {
        file: file.to_owned(),
        line: match why {
            NotCompiled::Error { line, .. } => *line,
            NotCompiled::Unreadable(_)
            | NotCompiled::MissingDeclaration(_)
            | NotCompiled::Compiler(_) => None,
        },
        text: file_message(file, why),
    };
    files.map(error).collect()
}

/// Returns the assignment with the viewer's `main` function and with each given file replaced by
/// what `given` returns for it. The new assignment is never freed.
fn with_probe(
    handed_out: &HandedOut,
    light: Package,
    given: impl Fn(&GivenFile) -> GivenFile,
) -> &'static HandedOut {
    let given: Vec<GivenFile> = handed_out.given.iter().map(given).collect();
    Box::leak(Box::new(HandedOut {
        given: given.leak(),
        entry: entry(light).leak(),
        substitutions: &[],
        ..*handed_out
    }))
}

/// Returns a given file, changed so that it records calls.
fn with_recording(file: &GivenFile) -> GivenFile {
    let mut methods = RECORDED.iter().filter(|method| method.file == file.name);
    let text = methods.next().and_then(|method| method.apply(file.text));
    GivenFile {
        name: file.name,
        text: text.map_or(file.text, |text| text.leak()),
    }
}
