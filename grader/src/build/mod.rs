//! From five files to a probe. A file that does not compile costs its own tasks: the starter's
//! takes its place.

mod blame;
mod built;
mod carried;
mod compile;
mod confined;
mod dependencies;
pub mod diagnostics;
mod kept;
mod lacking;
mod linker;
pub mod room;
mod rustc;
mod taken;
mod toolchain;
mod trial;

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::build::blame::{blame, blame_all, missing_parts};
use crate::build::carried::{CarryForward, NoParts, Parts};
use crate::build::compile::compile;
use crate::build::dependencies::{Dependencies, NoDependencies};
use crate::build::kept::Kept;
use crate::build::room::{Room, clear_up};
use crate::build::rustc::{Compiled, Rustc};
use crate::build::toolchain::{NoToolchain, Toolchain};
use crate::exam::Task;
use crate::given::{TASK_FILES, TaskFile};
use crate::sandbox::{Isolation, Sandbox};
use crate::submission::{Submission, Unreadable};
use crate::workspace::Workspace;

pub use crate::build::blame::NotCompiled;
pub use crate::build::built::{Build, Carried};
pub use crate::build::kept::Content;
pub use crate::build::toolchain::modified;
pub use crate::build::trial::Shortfall;

/// How often a submission is compiled at most.
const ATTEMPTS: usize = 3;

/// What submissions are built with: made once, used for many.
#[derive(Clone, Debug)]
pub struct Builder {
    rustc: Rustc,
    /// The reference's parts, where it is at hand.
    parts: Option<Parts>,
    folder: PathBuf,
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
    /// There is nothing to carry forward on.
    #[error(transparent)]
    Parts(#[from] NoParts),
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
        let folder = workspace.grade().join("work");
        clear_up(&folder);
        Ok(Builder {
            rustc: Rustc {
                toolchain,
                dependencies,
                kept: None,
                sandbox: Sandbox::none(),
            },
            parts: None,
            folder,
        })
    }

    /// Builds that can be carried forward as well, on the parts of this reference.
    pub fn with_reference(
        self,
        reference: &Path,
        workspace: &Workspace,
    ) -> Result<Self, BuildError> {
        let cache = workspace.grade().join("parts");
        let parts = Parts::prepare(reference, &cache, &self.rustc)?;
        Ok(Builder {
            parts: Some(parts),
            ..self
        })
    }

    /// Builds that may name more crates of the lock file: for solutions of ours that need them, and
    /// never for submissions.
    pub fn and_crates(&self, names: &[String], workspace: &Workspace) -> Result<Self, BuildError> {
        let mut builder = self.clone();
        builder.rustc.dependencies = Dependencies::and(names, workspace, &self.rustc.toolchain)?;
        Ok(builder)
    }

    /// The name of all that programs follow from, beside the submission.
    pub fn identity(&self) -> String {
        let parts = self.parts.as_ref().map(Parts::content).unwrap_or_default();
        parts.with(self.rustc.identity()).name()
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
    pub fn within(mut self, sandbox: Sandbox) -> Self {
        self.rustc.sandbox = sandbox;
        self
    }

    /// Keeps all programs in this folder, and takes them from there when the same is built again.
    pub fn keeping(mut self, folder: &Path) -> Result<Self, BuildError> {
        let kept = Kept::in_folder(folder).map_err(|source| BuildError::Io {
            path: folder.to_owned(),
            source,
        })?;
        self.rustc.kept = Some(kept);
        Ok(self)
    }

    /// Builds a submission, with the starter's file in place of each that can not be compiled.
    pub fn build(&self, submission: &Submission) -> Result<Build, BuildError> {
        self.build_telling(submission, |_| {})
    }

    /// The same; says which files can not be compiled before the others are, whenever there are
    /// more of them. A student need not wait for what is graded all the same.
    pub fn build_telling(
        &self,
        submission: &Submission,
        mut tell: impl FnMut(&BTreeMap<&'static str, NotCompiled>),
    ) -> Result<Build, BuildError> {
        let io = |source| BuildError::Io {
            path: self.folder.clone(),
            source,
        };
        let room = Room::new_in(&self.folder).map_err(io)?;
        let mut not_compiled = missing_parts(submission);

        let mut probe = None;
        for attempt in 0..ATTEMPTS {
            let files = with_stand_ins(submission, &not_compiled);
            let place = room.path().join(attempt.to_string());
            match compile(&files, &place, &self.rustc).map_err(io)? {
                Compiled::Done(path) => {
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
            tell(&not_compiled);
            if not_compiled.len() == submission.files.len() {
                break;
            }
        }
        if probe.is_none() {
            self.prove(room.path())?;
            let why = "the files that were left did not compile together";
            blame_all(submission, why, &mut not_compiled);
        }
        Ok(Build {
            carry: self.carry(submission, &not_compiled, room.path()),
            probe,
            not_compiled,
            sandbox: self.rustc.sandbox.clone(),
            _room: room,
        })
    }

    /// Compiles the starter, where nothing of a submission did: if even that fails, then a full
    /// disk, a broken linker or too little memory is to blame, and no student.
    fn prove(&self, folder: &Path) -> Result<(), BuildError> {
        let starter = TASK_FILES.map(|file| (file.name, file.starter));
        let why = match compile(&starter, &folder.join("starter"), &self.rustc) {
            Ok(Compiled::Done(_)) => return Ok(()),
            Ok(Compiled::Errors(errors)) => errors[0].text().to_owned(),
            Ok(Compiled::Failed(why)) => why,
            Err(error) => error.to_string(),
        };
        Err(BuildError::Machine(why))
    }

    fn carry(
        &self,
        submission: &Submission,
        not_compiled: &BTreeMap<&'static str, NotCompiled>,
        room: &Path,
    ) -> Option<CarryForward> {
        let parts = self.parts.clone()?;
        let mut files = submission.files.iter();
        let (file, text) = files.find(|(file, _)| file.name == Task::Traverse.file())?;
        let bvh = text.as_ref().ok()?.clone();
        (!not_compiled.contains_key(file.name)).then(|| CarryForward {
            bvh,
            parts,
            rustc: self.rustc.clone(),
            folder: room.join("carried"),
            program: OnceLock::new(),
        })
    }
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
