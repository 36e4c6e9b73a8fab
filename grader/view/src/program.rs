//! Builds the programs that run a submission's code for both parts: one that draws, and one that
//! records tests.
//!
//! Each part is compiled as a library, and a small program is linked with both. This way, saving a
//! file only compiles the part that it belongs to.

use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use grader::build::{Build, Builder, LinkedProgram, NotCompiled};
use grader::handed_out::{GivenFile, HandedOut, LIGHT, RAYS};
use grader::probe::Launcher;
use grader::select_isolation::{IsolationRequest, with_requested_level};
use grader::submission::{Submission, SubmissionError};
use grader::verdict::messages::file_message;
use grader::workspace::Workspace;
use serde::Serialize;

use crate::error::ViewError;
use crate::recording::RECORDED;

/// The name and the folder of the package that answers the viewer's requests.
const PROBE: (&str, &str) = ("view_probe", "grader/view/probe");
/// The source of both programs.
const MAIN: &str = "
/// Answers the viewer's requests.
fn main() -> std::process::ExitCode {
    view_probe::main(&rays::world::Student, &light::integrator::Light)
}
";

/// The folder or archive with the files of one part.
#[derive(Clone, Debug)]
pub struct Source {
    /// The path.
    pub path: PathBuf,
    /// Whether the folder is a package, i.e. has its files in `src`.
    pub is_package: bool,
}

/// The files of both parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Files {
    /// Part one.
    pub rays: Submission,
    /// Part two.
    pub light: Submission,
}

/// The files to view, and the compiler.
#[derive(Debug)]
pub struct Programs {
    builder: Builder,
    rays: Source,
    light: Source,
    drawing: Library,
    recording: Library,
    lighting: Library,
}

/// One part, compiled as a library.
#[derive(Debug)]
struct Library {
    handed_out: &'static HandedOut,
    /// The files that were compiled last, and the result.
    last: Mutex<Option<(Submission, Arc<Build>)>>,
}

impl Source {
    fn collect(&self, handed_out: &'static HandedOut) -> Result<Submission, SubmissionError> {
        if self.is_package {
            Submission::collect_package(&self.path, handed_out)
        } else {
            Submission::collect(&self.path, handed_out)
        }
    }
}

impl Library {
    /// Creates a library from an assignment, with each given file replaced by what `given` returns
    /// for it. The new assignment is never freed.
    fn new(handed_out: &HandedOut, given: impl Fn(&GivenFile) -> GivenFile) -> Self {
        let given: Vec<GivenFile> = handed_out.given.iter().map(given).collect();
        Library {
            handed_out: Box::leak(Box::new(HandedOut {
                given: given.leak(),
                entry: "",
                substitutions: &[],
                ..*handed_out
            })),
            last: Mutex::default(),
        }
    }

    /// Builds the library, unless these are the files that were built last. Calls `report` with
    /// errors as soon as the compiler has found them.
    ///
    /// # Errors
    /// Fails if the files don't compile or the compiler could not be run.
    fn build(
        &self,
        submission: &Submission,
        builder: &Builder,
        mut report: impl FnMut(Vec<FileError>),
    ) -> Result<Arc<Build>, BuildState> {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let known = last.as_ref().filter(|(files, _)| files == submission);
        let build = match known {
            Some((_, build)) => Arc::clone(build),
            None => {
                let mut submission = submission.clone();
                let files = submission.clone();
                submission.handed_out = self.handed_out;
                let build = builder.build_with_progress(&submission, |errors| {
                    report(file_errors(errors.iter().map(|(file, why)| (*file, why))));
                });
                let build = build.map_err(|error| BuildState::Broken(error.to_string()))?;
                Arc::clone(&last.insert((files, Arc::new(build))).1)
            }
        };
        let errors = file_errors(build.not_compiled.iter().map(|(file, why)| (*file, why)));
        if errors.is_empty() && build.probe.is_some() {
            Ok(build)
        } else {
            Err(BuildState::Failed(errors))
        }
    }
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
pub struct Program(Arc<LinkedProgram>);

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
    /// Prepares the compiler, in a sandbox if `isolation` requires one.
    pub fn prepare(
        workspace: &Workspace,
        rays: Source,
        light: Source,
        isolation: IsolationRequest,
    ) -> Result<Self, ViewError> {
        let builder = Builder::prepare_with_packages(&[PROBE], workspace);
        let builder = builder.map_err(ViewError::machine)?;
        Ok(Programs {
            builder: with_requested_level(builder, isolation).map_err(ViewError::machine)?,
            rays,
            light,
            drawing: Library::new(&RAYS, |file| *file),
            recording: Library::new(&RAYS, with_recording),
            lighting: Library::new(&LIGHT, |file| *file),
        })
    }

    /// Returns the assignments, each with the folder or archive of its files.
    pub fn sources(&self) -> [(&'static HandedOut, &Path); 2] {
        [(&RAYS, &self.rays.path), (&LIGHT, &self.light.path)]
    }

    /// Reads the current version of the files.
    pub fn collect(&self) -> Result<Files, SubmissionError> {
        Ok(Files {
            rays: self.rays.collect(&RAYS)?,
            light: self.light.collect(&LIGHT)?,
        })
    }

    /// Builds the program that records tests.
    pub fn build_recording(&self, files: &Files) -> BuildState {
        let mut rays = files.rays.clone();
        for method in RECORDED {
            for (file, text) in &mut rays.files {
                if file.name == method.file
                    && let Ok(text) = text
                    && let Some(recorded) = method.apply(text)
                {
                    *text = recorded;
                }
            }
        }
        let rays = self.recording.build(&rays, &self.builder, |_| {});
        let light = self.lighting.build(&files.light, &self.builder, |_| {});
        self.link([rays, light])
    }

    /// Builds the program that draws. Calls `report` with errors as soon as the compiler has found
    /// them.
    pub fn build(&self, files: &Files, report: impl Fn(Vec<FileError>) + Sync) -> BuildState {
        let builder = &self.builder;
        // At the start, both parts have to be compiled.
        let parts = thread::scope(|scope| {
            let light = scope.spawn(|| self.lighting.build(&files.light, builder, &report));
            let rays = self.drawing.build(&files.rays, builder, &report);
            let light = light.join().unwrap_or_else(|panic| resume_unwind(panic));
            [rays, light]
        });
        self.link(parts)
    }

    fn link(&self, parts: [Result<Arc<Build>, BuildState>; 2]) -> BuildState {
        match parts {
            [Ok(rays), Ok(light)] => match self.builder.link(MAIN, &[&rays, &light]) {
                Ok(program) => BuildState::Ready(Program(Arc::new(program))),
                Err(error) => BuildState::Broken(error.to_string()),
            },
            [
                Err(BuildState::Failed(rays)),
                Err(BuildState::Failed(light)),
            ] => BuildState::Failed([rays, light].concat()),
            [Err(failed), _] | [_, Err(failed)] => failed,
        }
    }
}

impl Program {
    /// Returns how to start the program.
    pub fn launcher(&self) -> &Launcher {
        &self.0.launcher
    }
}

fn file_errors<'a>(files: impl Iterator<Item = (&'static str, &'a NotCompiled)>) -> Vec<FileError> {
    let error = |(file, why): (&'static str, &NotCompiled)| FileError {
        file: file.to_owned(),
        line: if let NotCompiled::Error { line, .. } = why {
            *line
        } else {
            None
        },
        text: file_message(file, why),
    };
    files.map(error).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_save_compiles_only_its_own_part() {
        let workspace = Workspace::find().unwrap();
        let starter = |handed_out: &HandedOut| Source {
            path: workspace.root().join(handed_out.starter),
            is_package: false,
        };
        let (rays, light) = (starter(&RAYS), starter(&LIGHT));
        let programs = Programs::prepare(&workspace, rays, light, IsolationRequest::OwnWork);
        let programs = programs.unwrap();
        let build = |files: &Files| {
            let state = programs.build(files, |_| {});
            assert!(matches!(state, BuildState::Ready(_)), "{state:?}");
            [&programs.drawing, &programs.lighting].map(|library| {
                let last = library.last.lock().unwrap();
                Arc::clone(&last.as_ref().unwrap().1)
            })
        };
        let mut files = programs.collect().unwrap();
        let mut before = build(&files);
        for part in [1, 0] {
            let saved = [&mut files.rays, &mut files.light].into_iter().nth(part);
            let (_, text) = &mut saved.unwrap().files[0];
            *text = text.clone().map(|text| text + "\n// Saved.\n");
            let after = build(&files);
            let is_reused = [0, 1].map(|index| Arc::ptr_eq(&before[index], &after[index]));
            assert_eq!(is_reused, [part != 0, part != 1]);
            before = after;
        }
    }
}
