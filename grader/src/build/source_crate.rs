//! A crate to compile, and the outcome of compiling it.

use std::path::{Path, PathBuf};

use crate::build::diagnostics::Diagnostic;

/// A crate to compile.
#[derive(Debug)]
pub struct Crate<'a> {
    /// Name of the crate.
    pub name: &'a str,
    /// Whether to compile the crate as a program or as a library.
    pub kind: CrateKind,
    /// Folder that contains the sources. The output is also written there.
    pub folder: &'a Path,
    /// Path of the root module's file, relative to `folder`.
    pub root: &'a str,
    /// Names and libraries of the crates that this crate may import, in addition to those that
    /// every submission may import.
    pub links: &'a [(&'a str, &'a Path)],
    /// Folder that contains the dependencies of `links`, apart from the crates that every
    /// submission may import. `None` if `links` doesn't need other crates.
    pub dependency_folder: Option<&'a Path>,
}

impl<'a> Crate<'a> {
    /// Returns a crate of `kind` that imports only the crates that every submission may import.
    pub fn new(name: &'a str, kind: CrateKind, folder: &'a Path, root: &'a str) -> Self {
        Crate {
            name,
            kind,
            folder,
            root,
            links: &[],
            dependency_folder: None,
        }
    }
}

/// The kind of output that compiling a crate produces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CrateKind {
    /// An executable.
    Program,
    /// An `rlib` and its metadata. The metadata alone is enough to compile other crates against it.
    Library,
}

impl CrateKind {
    /// Returns the name of the compiler's output file.
    pub(super) fn file_name(self, name: &str) -> String {
        match self {
            CrateKind::Program => format!("{name}{}", std::env::consts::EXE_SUFFIX),
            CrateKind::Library => format!("lib{name}.rlib"),
        }
    }
}

/// Result of a compiler call.
#[derive(Debug)]
pub enum CompileOutcome {
    /// The crate was compiled.
    Done {
        /// The program or library.
        path: PathBuf,
        /// The compiler's warnings.
        warnings: Vec<Diagnostic>,
    },
    /// The source code has errors.
    Errors(Vec<Diagnostic>),
    /// The compiler didn't finish, or it failed and no error could be parsed from its messages.
    Failed(String),
}

impl CompileOutcome {
    /// Returns the program or library, or the reason there is none.
    pub fn into_result(self) -> Result<PathBuf, String> {
        match self {
            CompileOutcome::Done { path, .. } => Ok(path),
            CompileOutcome::Errors(errors) => Err(errors[0].text().to_owned()),
            CompileOutcome::Failed(why) => Err(why),
        }
    }

    /// Returns whether the compiler failed without any error about the source code.
    pub(super) fn is_unexplained(&self) -> bool {
        match self {
            CompileOutcome::Done { .. } => false,
            CompileOutcome::Errors(errors) => !errors.iter().any(Diagnostic::is_about_source),
            CompileOutcome::Failed(_) => true,
        }
    }
}
