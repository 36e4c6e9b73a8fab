//! Compiles one of a submission's files with the reference's parts in place of the other files.
//! This way, for example, a mistake in the box test doesn't cost points for tree traversal.
//!
//! The parts are some of the reference's files, compiled once. The submission's file is compiled
//! only against the metadata of the parts. It is then linked with the parts in a separate step,
//! which doesn't read the file's source. The reference's own version of the file isn't used. The
//! harness around the file may replace some of the file's functions: around `bvh.rs`, it replaces
//! the submission's `build` with a simple one, so that a mistake in building doesn't cost points
//! for traversal.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};

use judging::content_hash::ContentHash;
use tempfile::TempDir;

use crate::build::rustc::Rustc;
use crate::build::source_crate::{CompileOutcome, Crate, CrateKind};
use crate::error::Error;
use crate::handed_out::{HandedOut, SubstitutedFile, TaskFile};
use crate::machine::files::{self, AtPath};
use crate::sandbox::Sandbox;

/// The root of the crate that contains a submission's file.
const HARNESS: &str = "harness.rs";
/// The root of the crate that answers questions.
const PROBE: &str = "probe.rs";

/// The compiled parts, and the sources that connect a submission to them.
///
/// The sources of the two crates around a submission's file are kept with the reference instead of
/// being embedded in this program. Students can read the grader's sources, but the code that
/// replaces functions in the file must stay hidden from them.
#[derive(Clone, Debug)]
pub struct ReferenceParts {
    spec: &'static SubstitutedFile,
    folder: PathBuf,
    /// The root of the crate that contains the submission's file.
    root: String,
    /// The root of the crate that answers questions, compiled separately from the submission.
    probe: String,
    /// The module that wraps the submission's file in the crate that answers questions. It is named
    /// like the file.
    wrapper: String,
}

impl ReferenceParts {
    /// Returns the parts from `cache`, after compiling them if the reference's files or the
    /// compiler have changed.
    pub fn prepare(
        spec: &'static SubstitutedFile,
        handed_out: &HandedOut,
        reference: &Path,
        cache: &Path,
        rustc: &Rustc,
    ) -> Result<Self, Error> {
        // The course's own code needs no sandbox, and the same compiled files serve all isolation
        // levels.
        let rustc = &Rustc {
            sandbox: Sandbox::none(),
            ..rustc.clone()
        };
        let read = |name: &'static str| Ok((name, files::read_to_string(reference.join(name))?));
        let parts = handed_out.parts(spec).map(read);
        let parts: Vec<(&str, String)> = parts.collect::<Result<_, Error>>()?;
        let harness = reference.join("..").join(spec.folder());
        let root = parts_root(handed_out.parts(spec));
        let parts_of_file = ReferenceParts {
            spec,
            folder: cache.join(cache_key(&parts, &root, rustc)),
            root: files::read_to_string(harness.join(HARNESS))?,
            probe: files::read_to_string(harness.join(PROBE))?,
            wrapper: files::read_to_string(harness.join(spec.file))?,
        };
        let folder = &parts_of_file.folder;
        if folder.is_dir() {
            return Ok(parts_of_file);
        }
        files::create_dir_all(cache)?;
        let work = TempDir::new_in(cache).at("create a folder in", cache)?;
        compile_parts(&parts, &root, work.path(), rustc)?;
        // Renaming makes the folder appear all at once, never half-written. Another process may
        // have created it first.
        match fs::rename(work.path(), folder) {
            Err(_) if folder.is_dir() => {}
            renamed => renamed.at("create", folder)?,
        }
        Ok(parts_of_file)
    }

    /// Returns a hash of everything the parts and the harness depend on.
    pub fn content_hash(&self) -> ContentHash {
        ContentHash::default()
            .with(self.folder.as_os_str().as_encoded_bytes())
            .with(self.root.as_bytes())
            .with(self.probe.as_bytes())
            .with(self.wrapper.as_bytes())
    }

    /// Returns the name of the submission's file.
    pub fn file(&self) -> &'static str {
        self.spec.file
    }

    fn metadata(&self) -> PathBuf {
        self.folder.join("libparts.rmeta")
    }

    fn library(&self) -> PathBuf {
        self.folder.join("libparts.rlib")
    }
}

/// Returns the name of a file's module.
fn module(file: &str) -> &str {
    file.trim_end_matches(".rs")
}

/// Returns the source of the parts' root module.
fn parts_root(parts: impl Iterator<Item = &'static str>) -> String {
    parts
        .map(|file| format!("pub mod {};\n", module(file)))
        .collect()
}

/// Returns a hash of everything the parts depend on: their sources and the compiler.
fn cache_key(parts: &[(&str, String)], root: &str, rustc: &Rustc) -> String {
    let compiler_and_root = ContentHash::default()
        .with(rustc.identity())
        .with(root.as_bytes());
    let all = parts
        .iter()
        .fold(compiler_and_root, |content, (name, text)| {
            content.with(name.as_bytes()).with(text.as_bytes())
        });
    all.hex()
}

fn compile_parts(
    parts: &[(&str, String)],
    root: &str,
    folder: &Path,
    rustc: &Rustc,
) -> Result<(), Error> {
    for (name, text) in parts {
        files::write(folder.join(name), text)?;
    }
    files::write(folder.join("parts.rs"), root)?;
    let library = Crate::new("parts", CrateKind::Library, folder, "parts.rs");
    let compiled = rustc.compile(&library).at("compile in", folder)?;
    let message = "the reference does not compile: run `cargo check -p reference` to see why";
    compiled
        .into_result()
        .map_err(|_| Error::machine(message))?;
    // The sources are no longer needed, and keeping them would leave a solution on this machine.
    for (name, _) in parts {
        files::remove_if_exists(folder.join(name))?;
    }
    Ok(())
}

/// A submission's file, which is compiled with the reference's parts only if needed.
#[derive(Debug)]
pub struct Substitution {
    /// The file.
    pub file: TaskFile,
    /// The text of the submission's file.
    pub source: String,
    /// The assignment.
    pub handed_out: &'static HandedOut,
    /// The parts that replace the submission's other files.
    pub parts: ReferenceParts,
    /// The compiler, which compiles the program on the first request.
    pub rustc: Rustc,
    /// The build folder, which doesn't exist yet.
    pub folder: PathBuf,
    /// The result of compiling the program, once it has been requested.
    pub program: OnceLock<Option<PathBuf>>,
    /// Locked while the program is compiled, since two tasks may request it at the same time.
    pub compiling: Mutex<()>,
}

impl Substitution {
    /// Returns the program, or `None` if it doesn't compile, e.g. because the file uses helpers
    /// from the submission's other files.
    pub fn program(&self) -> io::Result<Option<&Path>> {
        let compiling = self.compiling.lock();
        let _guard = compiling.unwrap_or_else(PoisonError::into_inner);
        if self.program.get().is_none() {
            let program = self.compile()?;
            self.program.get_or_init(|| program);
        }
        Ok(self.program.get().and_then(Option::as_deref))
    }

    fn compile(&self) -> io::Result<Option<PathBuf>> {
        let content = self.parts.content_hash().with(self.source.as_bytes());
        let compiled = self
            .rustc
            .compile_cached(&content, || self.compile_uncached());
        let is_explained = match compiled? {
            CompileOutcome::Done { path, .. } => return Ok(Some(path)),
            CompileOutcome::Errors(errors) => errors
                .iter()
                .any(|error| error.blamed_file(self.handed_out.files).is_some()),
            CompileOutcome::Failed(_) => false,
        };
        if !is_explained {
            self.starter_program()?;
        }
        Ok(None)
    }

    /// Compiles the starter's file with the parts. Called if no error explains why the submission's
    /// file doesn't compile, or if the program built from that file cannot be started. If the
    /// starter's file doesn't compile either, the machine is to blame.
    pub(super) fn starter_program(&self) -> io::Result<PathBuf> {
        let starter = Substitution {
            file: self.file,
            source: self.file.starter.to_owned(),
            handed_out: self.handed_out,
            parts: self.parts.clone(),
            rustc: self.rustc.for_own_code(),
            // If this folder were next to the submission's folder, the compiled files of both would
            // have the same path.
            folder: self.folder.join("starter").join(self.file.name),
            program: OnceLock::new(),
            compiling: Mutex::default(),
        };
        starter.compile_uncached()?.into_result().map_err(|why| {
            io::Error::other(format!(
                "even the unmodified starter version of {} fails to compile with the reference's parts: {why}",
                self.file.name
            ))
        })
    }

    fn compile_uncached(&self) -> io::Result<CompileOutcome> {
        fs::create_dir_all(&self.folder)?;
        let parts = &self.parts;
        fs::write(self.folder.join(HARNESS), &parts.root)?;
        fs::write(self.folder.join(self.file.name), &self.source)?;
        let submission = self.rustc.compile(&Crate {
            links: &[("parts", &parts.metadata())],
            ..Crate::new("submission", CrateKind::Library, &self.folder, HARNESS)
        })?;
        let submission = match submission {
            CompileOutcome::Done { path, .. } => path,
            failed @ (CompileOutcome::Errors(_) | CompileOutcome::Failed(_)) => return Ok(failed),
        };

        let joined = self.folder.join("joined");
        fs::create_dir_all(&joined)?;
        let given = self.handed_out.given.iter();
        let given = given.filter(|file| parts.spec.given.contains(&file.name));
        let harness = [(PROBE, &*parts.probe), (self.file.name, &*parts.wrapper)];
        for (name, text) in given.map(|file| (file.name, file.text)).chain(harness) {
            fs::write(joined.join(name), text)?;
        }
        self.rustc.compile(&Crate {
            links: &[("submission", &submission), ("parts", &parts.library())],
            dependency_folder: Some(&parts.folder),
            ..Crate::new("probe", CrateKind::Program, &joined, PROBE)
        })
    }
}
