//! Builds a probe from a submission's task files. A file that doesn't compile is replaced by the
//! starter's version, so that only its own tasks fail.

mod blame;
pub mod build_dir;
mod compile;
mod compile_budget;
pub mod compiler_help;
mod compiler_sandbox;
mod dependencies;
pub mod diagnostics;
mod linker;
mod machine_fault;
mod programs;
mod rustc;
pub mod select_isolation;
mod self_test;
mod source_crate;
mod substitution;
mod toolchain;
mod trial;
mod verified_copy;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock};
use std::time::Instant;

use judging::assignment::Task;
use judging::content_hash::ContentHash;

use crate::build::blame::{
    because_of, blame, blame_all, explain, incomplete_files, unreadable_files,
};
use crate::build::build_dir::{BuildDir, remove_abandoned};
use crate::build::compile::{ROOT, compile, compile_starter};
use crate::build::dependencies::Dependencies;
use crate::build::diagnostics::Diagnostic;
use crate::build::rustc::Rustc;
use crate::build::source_crate::{CompileOutcome, Crate, CrateKind};
use crate::build::substitution::{ReferenceParts, Substitution};
use crate::build::toolchain::Toolchain;
use crate::error::Error;
use crate::handed_out::{HandedOut, TaskFile, TaskMethods};
use crate::machine::files::{self, AtPath};
use crate::probe::{Interrupt, Launcher};
use crate::sandbox::{Isolation, Sandbox};
use crate::submission::{Submission, TaskFileError};
use crate::workspace::Workspace;

pub use crate::build::blame::{NotCompiled, RESTORE_LABEL};
pub use crate::build::programs::{Build, LinkedProgram, SubstitutedProgram};
pub use crate::build::self_test::SelfTestError;
pub use crate::build::toolchain::file_fingerprint;

/// A compiled program and the compiler's warnings.
type Compiled = (PathBuf, Vec<Diagnostic>);
/// The files that aren't compiled, each with the reason.
type Rejected = BTreeMap<&'static str, NotCompiled>;

/// Maximum number of attempts to compile a submission.
const MAX_ATTEMPTS: usize = 3;

/// Builds submissions. A builder is prepared once and used for many submissions.
#[derive(Clone, Debug)]
pub struct Builder {
    rustc: Rustc,
    /// The reference's parts for each file that can be graded with them. Empty if there is no
    /// reference.
    reference_parts: Vec<ReferenceParts>,
    folder: PathBuf,
}

impl Builder {
    /// Finds the compiler and builds the dependencies unless they are cached.
    pub fn prepare(workspace: &Workspace) -> Result<Self, Error> {
        let toolchain = Toolchain::find()?;
        let dependencies = Dependencies::prepare(workspace, &toolchain)?;
        Ok(Builder::new(toolchain, dependencies, workspace))
    }

    fn new(toolchain: Toolchain, dependencies: Dependencies, workspace: &Workspace) -> Self {
        let folder = workspace.cache_folder().join("work");
        remove_abandoned(&folder);
        Builder {
            rustc: Rustc::new(toolchain, dependencies),
            reference_parts: Vec::new(),
            folder,
        }
    }

    /// Returns a builder that can also compile a submission's file with parts of this reference in
    /// place of the submission's other files.
    pub fn with_reference(
        self,
        reference: &Path,
        handed_out: &'static HandedOut,
        workspace: &Workspace,
    ) -> Result<Self, Error> {
        let cache = workspace.cache_folder().join("parts");
        let parts = handed_out
            .substitutions
            .iter()
            .map(|file| ReferenceParts::prepare(file, handed_out, reference, &cache, &self.rustc))
            .collect::<Result<_, _>>()?;
        Ok(Builder {
            reference_parts: parts,
            ..self
        })
    }

    /// Returns a builder whose programs can import additional crates from the lock file. Only for
    /// the course's own solutions, never for submissions.
    pub fn with_crates(&self, names: &[String], workspace: &Workspace) -> Result<Self, Error> {
        let mut builder = self.clone();
        builder.rustc.dependencies =
            Dependencies::with_crates(names, workspace, &self.rustc.toolchain)?;
        Ok(builder)
    }

    /// Finds the compiler and builds the dependencies, along with crates from this workspace that
    /// programs can then import. `packages` are their names and folders. Not for grading.
    pub fn prepare_with_packages(
        packages: &[(&str, &str)],
        workspace: &Workspace,
    ) -> Result<Self, Error> {
        let toolchain = Toolchain::find()?;
        let dependencies = Dependencies::with_packages(packages, workspace, &toolchain)?;
        Ok(Builder::new(toolchain, dependencies, workspace))
    }

    /// Returns a hash of everything that programs depend on besides the submission.
    pub fn identity(&self) -> String {
        let parts = self.reference_parts.iter();
        let identity = ContentHash::default().with(self.rustc.identity());
        let all = parts.fold(identity, |content, parts| {
            content.with(parts.content_hash().hex().as_bytes())
        });
        all.hex()
    }

    /// Returns the path of the compiler.
    pub fn compiler(&self) -> &Path {
        &self.rustc.toolchain.rustc
    }

    /// Returns the folder that contains the crates that every submission is linked with.
    pub fn dependencies(&self) -> &Path {
        &self.rustc.dependencies.folder
    }

    /// Returns the isolation level for compiling and running submissions.
    pub fn isolation(&self) -> Isolation {
        self.rustc.sandbox.level()
    }

    /// Returns a builder that compiles and runs submissions in this sandbox.
    pub fn with_sandbox(mut self, sandbox: Sandbox) -> Self {
        self.rustc.sandbox = sandbox;
        self
    }

    /// Returns a builder that stores all programs in this folder and reuses them.
    pub fn with_cache(mut self, folder: &Path) -> Result<Self, Error> {
        files::create_dir_all(folder)?;
        self.rustc.cache = Some(folder.to_owned());
        Ok(self)
    }

    /// Builds a submission. Each file that doesn't compile is replaced by the starter's version.
    pub fn build(&self, submission: &Submission) -> Result<Build, Error> {
        self.build_with_progress(submission, |_| {})
    }

    /// Builds a submission as [`Builder::build`] does, but calls `report_errors` whenever it finds
    /// more files that don't compile, before it compiles the other files. This way, students see
    /// errors early.
    pub fn build_with_progress(
        &self,
        submission: &Submission,
        mut report_errors: impl FnMut(&Rejected),
    ) -> Result<Build, Error> {
        let started_at = Instant::now();
        let build_dir = BuildDir::new_in(&self.folder)?;
        let rustc = &self.rustc.for_submission();
        let handed_out = submission.handed_out;
        let mut not_compiled = unreadable_files(submission);
        let mut compiled = None;
        let mut incomplete = incomplete_files(submission);
        if !incomplete.is_empty() {
            let files = with_starter_files(submission, &not_compiled);
            let folder = build_dir.path().join("as handed in");
            match compile(&files, handed_out, &folder, rustc).at("build in", &self.folder)? {
                // The declaration exists, but is written in an unusual way.
                CompileOutcome::Done { path, warnings } => {
                    compiled = Some((path, warnings));
                    incomplete.clear();
                }
                CompileOutcome::Errors(errors) => explain(&mut incomplete, &errors),
                CompileOutcome::Failed(_) => {}
            }
            not_compiled.append(&mut incomplete);
            report_errors(&not_compiled);
        }
        let attempts = if compiled.is_some() { 0 } else { MAX_ATTEMPTS };
        // The files that were rejected before the first attempt, and that attempt's errors.
        let mut first = None;
        for attempt in 0..attempts {
            let files = with_starter_files(submission, &not_compiled);
            let folder = build_dir.path().join(attempt.to_string());
            match compile(&files, handed_out, &folder, rustc).at("build in", &self.folder)? {
                CompileOutcome::Done { path, warnings } => {
                    compiled = Some((path, warnings));
                    break;
                }
                CompileOutcome::Errors(errors) => {
                    let before = not_compiled.clone();
                    let named = blame(&errors, submission, &mut not_compiled);
                    let (rejected, errors) = first.get_or_insert((before, errors));
                    // A change in one file can cause errors in several others, or only in given
                    // files and in the starter's version of another file.
                    if named != 1 {
                        let folder = build_dir.path().join(format!("{attempt} one of"));
                        let found = self.culprit(submission, rejected, errors, &folder, rustc)?;
                        if let Some((culprit, outcome)) = found {
                            not_compiled = culprit;
                            compiled = Some(outcome);
                        } else if named == 0 {
                            blame_all(submission, errors[0].text(), &mut not_compiled);
                        }
                    }
                }
                CompileOutcome::Failed(why) => blame_all(submission, &why, &mut not_compiled),
            }
            report_errors(&not_compiled);
            if compiled.is_some() || not_compiled.len() == submission.files.len() {
                break;
            }
        }
        if compiled.is_none() {
            // If the starter doesn't compile either, the cause is the machine (a full disk, a
            // broken linker or too little memory), not the submission.
            let folder = build_dir.path().join("starter");
            let starter = compile_starter(handed_out, &folder, &self.rustc);
            starter.map_err(|why| {
                Error::Machine(format!(
                    "even the unmodified starter code fails to compile on this machine: is the disk full, or is the linker \
                     missing?\n{why}"
                ))
            })?;
            let why = "the remaining files do not compile together";
            blame_all(submission, why, &mut not_compiled);
        }
        let (probe, warnings) = compiled.unzip();
        Ok(Build {
            handed_out,
            substitutions: self.substitutions(submission, &not_compiled, rustc, build_dir.path()),
            probe,
            methods: task_methods(submission),
            warnings: warnings.unwrap_or_default(),
            not_compiled,
            took: started_at.elapsed(),
            interrupt: Interrupt::default(),
            unstartable: Mutex::default(),
            rustc: self.rustc.clone(),
            build_dir,
        })
    }

    /// Compiles a program that imports these submissions, which were built as libraries. `main` is
    /// the course's own code, so every failure is the machine's.
    pub fn link(&self, main: &str, libraries: &[&Build]) -> Result<LinkedProgram, Error> {
        let build_dir = BuildDir::new_in(&self.folder)?;
        let folder = build_dir.path();
        files::write(folder.join(ROOT), main)?;
        let links = libraries.iter().filter_map(|library| {
            let path = library.probe.as_deref()?;
            Some((library.handed_out.assignment.id, path))
        });
        let links: Vec<(&str, &Path)> = links.collect();
        let rustc = self.rustc.for_own_code();
        let compiled = rustc.compile(&Crate {
            links: &links,
            ..Crate::new("probe", CrateKind::Program, folder, ROOT)
        });
        let compiled = compiled.at("build in", &self.folder)?;
        Ok(LinkedProgram {
            launcher: Launcher {
                program: compiled.into_result().map_err(Error::Machine)?,
                sandbox: rustc.sandbox,
                interrupt: Interrupt::default(),
            },
            _build_dir: build_dir,
        })
    }

    /// Searches for a file that is the only cause of these errors: with the starter's version of
    /// this file and of the `rejected` files, the submission compiles. Returns all files that don't
    /// compile, along with the program without them.
    fn culprit(
        &self,
        submission: &Submission,
        rejected: &Rejected,
        errors: &[Diagnostic],
        folder: &Path,
        rustc: &Rustc,
    ) -> Result<Option<(Rejected, Compiled)>, Error> {
        for (file, _) in &submission.files {
            let mut not_compiled = rejected.clone();
            if not_compiled.contains_key(file.name) {
                continue;
            }
            not_compiled.insert(file.name, because_of(file, submission, errors));
            let files = with_starter_files(submission, &not_compiled);
            let folder = folder.join(file.name);
            let outcome = compile(&files, submission.handed_out, &folder, rustc);
            if let CompileOutcome::Done { path, warnings } = outcome.at("build in", &folder)? {
                return Ok(Some((not_compiled, (path, warnings))));
            }
        }
        Ok(None)
    }

    /// Returns the submission's files that can be graded with the reference's parts.
    fn substitutions(
        &self,
        submission: &Submission,
        not_compiled: &BTreeMap<&'static str, NotCompiled>,
        rustc: &Rustc,
        build_dir: &Path,
    ) -> Vec<Substitution> {
        let substitution = |parts: &ReferenceParts| {
            let mut files = submission.files.iter();
            let (file, text) = files.find(|(file, _)| file.name == parts.file())?;
            let source = text.as_ref().ok()?.clone();
            (!not_compiled.contains_key(file.name)).then(|| Substitution {
                file: *file,
                source,
                parts: parts.clone(),
                handed_out: submission.handed_out,
                rustc: rustc.clone(),
                folder: build_dir.join("substitution").join(file.name),
                program: OnceLock::new(),
                compiling: Mutex::default(),
            })
        };
        self.reference_parts
            .iter()
            .filter_map(substitution)
            .collect()
    }
}

/// Returns a submission's method for each task. Methods that aren't found are left out.
fn task_methods(submission: &Submission) -> BTreeMap<Task, TaskMethods> {
    let handed_out = submission.handed_out;
    let method = |task: Task| {
        let name = handed_out.assignment.info(task).file;
        let mut files = submission.files.iter();
        let (_, text) = files.find(|(file, _)| file.name == name)?;
        let method = handed_out.task_methods(task, text.as_ref().ok()?).ok()?;
        Some((task, method))
    };
    handed_out.assignment.tasks().filter_map(method).collect()
}

fn with_starter_files<'a>(
    submission: &'a Submission,
    not_compiled: &BTreeMap<&str, NotCompiled>,
) -> Vec<(&'static str, &'a str)> {
    let text = |(file, text): &'a (TaskFile, Result<String, TaskFileError>)| match text {
        Ok(text) if !not_compiled.contains_key(file.name) => (file.name, text.as_str()),
        Ok(_) | Err(_) => (file.name, file.starter),
    };
    submission.files.iter().map(text).collect()
}

#[cfg(test)]
mod tests;
