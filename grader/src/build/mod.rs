//! From five files to a probe. A file that does not compile costs its own tasks: the starter's
//! takes its place.

mod blame;
pub mod build_dir;
mod compile;
mod compiler_sandbox;
mod dependencies;
pub mod diagnostics;
mod linker;
mod machine_fault;
mod program_cache;
mod programs;
mod rustc;
mod self_test;
mod substitution;
mod toolchain;
mod verified_copy;

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::build::blame::{blame, blame_all, unusable_files};
use crate::build::build_dir::{BuildDir, remove_abandoned};
use crate::build::compile::compile;
use crate::build::dependencies::{Dependencies, DependenciesError};
use crate::build::program_cache::ProgramCache;
use crate::build::rustc::{CompileOutcome, Rustc};
use crate::build::substitution::{ReferenceParts, Substitution, SubstitutionError};
use crate::build::toolchain::{Toolchain, ToolchainError};
use crate::exam::Task;
use crate::given_files::{TASK_FILES, TaskFile};
use crate::sandbox::{Isolation, Sandbox};
use crate::submission::{Submission, TaskFileError};
use crate::workspace::Workspace;

pub use crate::build::blame::NotCompiled;
pub use crate::build::program_cache::ContentHash;
pub use crate::build::programs::{Build, SubstitutedProgram};
pub use crate::build::self_test::SelfTestError;
pub use crate::build::toolchain::file_fingerprint;

/// How often a submission is compiled at most.
const MAX_ATTEMPTS: usize = 3;

/// What submissions are built with: made once, used for many.
#[derive(Clone, Debug)]
pub struct Builder {
    rustc: Rustc,
    /// The reference's parts, where it is at hand.
    reference_parts: Option<ReferenceParts>,
    folder: PathBuf,
}

/// The grader's own fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// There is no compiler.
    #[error(transparent)]
    Toolchain(#[from] ToolchainError),
    /// There is nothing to link with.
    #[error(transparent)]
    Dependencies(#[from] DependenciesError),
    /// There is nothing to carry forward on.
    #[error(transparent)]
    Substitution(#[from] SubstitutionError),
    /// Nothing compiles at all.
    #[error(
        "not even the files that were handed out compile on this machine; is the disk full, is there a linker?\n{0}"
    )]
    Machine(String),
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
        let folder = workspace.output_folder().join("work");
        remove_abandoned(&folder);
        Ok(Builder {
            rustc: Rustc {
                toolchain,
                dependencies,
                cache: None,
                sandbox: Sandbox::none(),
            },
            reference_parts: None,
            folder,
        })
    }

    /// Builds that can be carried forward as well, on the parts of this reference.
    pub fn with_reference(
        self,
        reference: &Path,
        workspace: &Workspace,
    ) -> Result<Self, BuildError> {
        let cache = workspace.output_folder().join("parts");
        let parts = ReferenceParts::prepare(reference, &cache, &self.rustc)?;
        Ok(Builder {
            reference_parts: Some(parts),
            ..self
        })
    }

    /// Builds that may name more crates of the lock file: for solutions of ours that need them, and
    /// never for submissions.
    pub fn with_crates(&self, names: &[String], workspace: &Workspace) -> Result<Self, BuildError> {
        let mut builder = self.clone();
        builder.rustc.dependencies =
            Dependencies::with_crates(names, workspace, &self.rustc.toolchain)?;
        Ok(builder)
    }

    /// The name of all that programs follow from, beside the submission.
    pub fn identity(&self) -> String {
        let parts = self
            .reference_parts
            .as_ref()
            .map(ReferenceParts::content_hash)
            .unwrap_or_default();
        parts.with(self.rustc.identity()).hex()
    }

    /// What compiles.
    pub fn compiler(&self) -> &Path {
        &self.rustc.toolchain.rustc
    }

    /// The folder with what every submission is linked with.
    pub fn dependencies(&self) -> &Path {
        &self.rustc.dependencies.folder
    }

    /// How submissions will be kept apart from the machine.
    pub fn isolation(&self) -> Isolation {
        self.rustc.sandbox.level()
    }

    /// Builds in this sandbox, and programs that are to be asked in it.
    pub fn with_sandbox(mut self, sandbox: Sandbox) -> Self {
        self.rustc.sandbox = sandbox;
        self
    }

    /// Keeps all programs in this folder, and takes them from there when the same is built again.
    pub fn with_cache(mut self, folder: &Path) -> Result<Self, BuildError> {
        let kept = ProgramCache::new(folder).map_err(|source| BuildError::Io {
            path: folder.to_owned(),
            source,
        })?;
        self.rustc.cache = Some(kept);
        Ok(self)
    }

    /// Builds a submission, with the starter's file in place of each that can not be compiled.
    pub fn build(&self, submission: &Submission) -> Result<Build, BuildError> {
        self.build_with_progress(submission, |_| {})
    }

    /// The same; says which files can not be compiled before the others are, whenever there are
    /// more of them. A student need not wait for what is graded all the same.
    pub fn build_with_progress(
        &self,
        submission: &Submission,
        mut tell: impl FnMut(&BTreeMap<&'static str, NotCompiled>),
    ) -> Result<Build, BuildError> {
        let io = |source| BuildError::Io {
            path: self.folder.clone(),
            source,
        };
        let build_dir = BuildDir::new_in(&self.folder).map_err(io)?;
        let mut not_compiled = unusable_files(submission);

        let mut probe = None;
        for attempt in 0..MAX_ATTEMPTS {
            let files = with_starter_files(submission, &not_compiled);
            let place = build_dir.path().join(attempt.to_string());
            match compile(&files, &place, &self.rustc).map_err(io)? {
                CompileOutcome::Done(path) => {
                    probe = Some(path);
                    break;
                }
                CompileOutcome::Errors(errors) => {
                    if !blame(&errors, &mut not_compiled) {
                        blame_all(submission, errors[0].text(), &mut not_compiled);
                    }
                }
                CompileOutcome::Failed(why) => blame_all(submission, &why, &mut not_compiled),
            }
            tell(&not_compiled);
            if not_compiled.len() == submission.files.len() {
                break;
            }
        }
        if probe.is_none() {
            self.check_machine(build_dir.path())?;
            let why = "the files that were left did not compile together";
            blame_all(submission, why, &mut not_compiled);
        }
        Ok(Build {
            substitution: self.substitution(submission, &not_compiled, build_dir.path()),
            probe,
            not_compiled,
            sandbox: self.rustc.sandbox.clone(),
            _build_dir: build_dir,
        })
    }

    /// Compiles the starter, where nothing of a submission did: if even that fails, then a full
    /// disk, a broken linker or too little memory is to blame, and no student.
    fn check_machine(&self, folder: &Path) -> Result<(), BuildError> {
        let starter = TASK_FILES.map(|file| (file.name, file.starter));
        let why = match compile(&starter, &folder.join("starter"), &self.rustc) {
            Ok(CompileOutcome::Done(_)) => return Ok(()),
            Ok(CompileOutcome::Errors(errors)) => errors[0].text().to_owned(),
            Ok(CompileOutcome::Failed(why)) => why,
            Err(error) => error.to_string(),
        };
        Err(BuildError::Machine(why))
    }

    fn substitution(
        &self,
        submission: &Submission,
        not_compiled: &BTreeMap<&'static str, NotCompiled>,
        build_dir: &Path,
    ) -> Option<Substitution> {
        let parts = self.reference_parts.clone()?;
        let mut files = submission.files.iter();
        let (file, text) = files.find(|(file, _)| file.name == Task::Traverse.file())?;
        let bvh = text.as_ref().ok()?.clone();
        (!not_compiled.contains_key(file.name)).then(|| Substitution {
            bvh,
            parts,
            rustc: self.rustc.clone(),
            folder: build_dir.join("carried"),
            program: OnceLock::new(),
        })
    }
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
