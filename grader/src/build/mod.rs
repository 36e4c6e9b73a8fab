//! From five files to a probe. A file that does not compile costs its own tasks: the starter's
//! takes its place.

mod compile;
mod dependencies;
mod diagnostics;
mod toolchain;

use std::collections::BTreeMap;
use std::io;
use std::path::PathBuf;

use tempfile::TempDir;

use crate::build::compile::{Compiled, compile};
use crate::build::dependencies::{Dependencies, NoDependencies};
use crate::build::diagnostics::Diagnostic;
use crate::build::toolchain::{NoToolchain, Toolchain};
use crate::given::TaskFile;
use crate::submission::{Submission, Unreadable};
use crate::workspace::Workspace;

/// How often a submission is compiled at most.
const ATTEMPTS: usize = 3;

/// What submissions are built with: made once, used for many.
#[derive(Clone, Debug)]
pub struct Builder {
    toolchain: Toolchain,
    dependencies: Dependencies,
    folder: PathBuf,
}

/// A submission, ready to be asked.
#[derive(Debug)]
pub struct Build {
    /// The program, unless nothing could be compiled.
    pub probe: Option<PathBuf>,
    /// The files whose tasks can not be graded, and why.
    pub not_compiled: BTreeMap<&'static str, NotCompiled>,
    /// Holds the program; vanishes with it.
    _folder: TempDir,
}

/// Why a file is not part of the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotCompiled {
    /// There is no text to compile.
    Unreadable(Unreadable),
    /// It lacks something that other files call.
    Lacks(&'static str),
    /// The compiler's first error in it.
    Error(String),
    /// The compiler did not finish, and did not say because of which file.
    Compiler(String),
}

/// The grader's own fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// There is no compiler.
    #[error(transparent)]
    Toolchain(#[from] NoToolchain),
    /// There is nothing to link with.
    #[error(transparent)]
    Dependencies(#[from] NoDependencies),
    /// The work folder can not be used.
    #[error("can not build in {path}: {source}")]
    Io {
        /// The folder.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

impl Builder {
    /// Finds the compiler and makes the dependencies, if they are not there yet.
    pub fn prepare(workspace: &Workspace) -> Result<Self, BuildError> {
        let toolchain = Toolchain::find()?;
        let dependencies = Dependencies::prepare(workspace, &toolchain)?;
        Ok(Builder {
            toolchain,
            dependencies,
            folder: workspace.grade().join("work"),
        })
    }

    /// Builds a submission, with the starter's file in place of each that can not be compiled.
    pub fn build(&self, submission: &Submission) -> Result<Build, BuildError> {
        let io = |source| BuildError::Io {
            path: self.folder.clone(),
            source,
        };
        std::fs::create_dir_all(&self.folder).map_err(io)?;
        // Fresh each time: nothing of an earlier submission can be taken for this one's.
        let folder = TempDir::new_in(&self.folder).map_err(io)?;
        let mut not_compiled = missing_parts(submission);

        let mut probe = None;
        for attempt in 0..ATTEMPTS {
            let files = with_stand_ins(submission, &not_compiled);
            let place = folder.path().join(attempt.to_string());
            match compile(&files, &place, &self.toolchain, &self.dependencies).map_err(io)? {
                Compiled::Probe(path) => {
                    probe = Some(path);
                    break;
                }
                Compiled::Errors(errors) => {
                    if !blame(&errors, &mut not_compiled) {
                        blame_all(submission, errors[0].text(), &mut not_compiled);
                    }
                }
                Compiled::Failed(why) => blame_all(submission, &why, &mut not_compiled),
            }
            if not_compiled.len() == submission.files.len() {
                break;
            }
        }
        if probe.is_none() {
            let why = "the files that were left did not compile together";
            blame_all(submission, why, &mut not_compiled);
        }
        Ok(Build {
            probe,
            not_compiled,
            _folder: folder,
        })
    }
}

/// Files that are not worth a compile: without text, or without what the others call.
fn missing_parts(submission: &Submission) -> BTreeMap<&'static str, NotCompiled> {
    let why = |file: &TaskFile, text: &Result<String, Unreadable>| match text {
        Err(unreadable) => Some(NotCompiled::Unreadable(unreadable.clone())),
        Ok(text) => {
            let lacking = file.needed.iter().find(|part| !text.contains(**part));
            lacking.map(|part| NotCompiled::Lacks(part))
        }
    };
    submission
        .files
        .iter()
        .filter_map(|(file, text)| Some((file.name, why(file, text)?)))
        .collect()
}

fn with_stand_ins<'a>(
    submission: &'a Submission,
    not_compiled: &BTreeMap<&str, NotCompiled>,
) -> Vec<(&'static str, &'a str)> {
    let text = |(file, text): &'a (TaskFile, Result<String, Unreadable>)| match text {
        Ok(text) if !not_compiled.contains_key(file.name) => (file.name, text.as_str()),
        Ok(_) | Err(_) => (file.name, file.starter),
    };
    submission.files.iter().map(text).collect()
}

/// Notes each file that the errors name, with its first error. False if they name no new one.
fn blame(errors: &[Diagnostic], not_compiled: &mut BTreeMap<&'static str, NotCompiled>) -> bool {
    let before = not_compiled.len();
    for error in errors {
        if let Some(name) = error.blamed() {
            let why = || NotCompiled::Error(error.text().to_owned());
            not_compiled.entry(name).or_insert_with(why);
        }
    }
    not_compiled.len() > before
}

fn blame_all(
    submission: &Submission,
    why: &str,
    not_compiled: &mut BTreeMap<&'static str, NotCompiled>,
) {
    for (file, _) in &submission.files {
        let why = || NotCompiled::Compiler(why.to_owned());
        not_compiled.entry(file.name).or_insert_with(why);
    }
}
