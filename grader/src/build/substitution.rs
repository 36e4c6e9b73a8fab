//! Compiles a submission's `bvh.rs` with the reference's parts, so that a mistake in the box test
//! does not also cost the points for traversing a tree.
//!
//! The parts are the reference's other four task files and `primitive.rs`, compiled once. The
//! submission is compiled against their metadata only, and linked with them in a step that reads
//! none of its source. The reference's own `bvh.rs` is not used. The submission's `build` is
//! replaced by a plain one, so that a mistake in building does not cost the points for traversing
//! either.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use tempfile::TempDir;

use crate::build::program_cache::ContentHash;
use crate::build::rustc::{CompileOutcome, Crate, CrateKind, Rustc};
use crate::given_files::{GIVEN_FILES, TASK_FILES};
use crate::sandbox::Sandbox;

/// The reference's files that make up the parts, in the order of their dependencies.
const PART_FILES: [&str; 5] = [
    "camera.rs",
    "bbox.rs",
    "triangle.rs",
    "sphere.rs",
    "primitive.rs",
];

/// The root module of the parts.
const PARTS_ROOT: &str = "
pub mod bbox;
pub mod camera;
pub mod primitive;
pub mod sphere;
pub mod triangle;
";
/// The files around a submission's `bvh.rs`. They are kept with the reference and not embedded in
/// this program, because students have the grader's sources, and the plain `build` must stay
/// hidden.
const SCAFFOLD_FILES: [&str; 3] = ["around.rs", "probe.rs", "bvh.rs"];

/// The compiled parts, and the sources that connect a submission to them.
#[derive(Clone, Debug)]
pub struct ReferenceParts {
    folder: PathBuf,
    scaffold: Scaffold,
}

/// Sources of the two crates that are built around a submission's `bvh.rs`.
#[derive(Clone, Debug)]
struct Scaffold {
    /// The root of the crate that contains the submission's `bvh.rs`.
    root: String,
    /// The files of the crate that answers questions, compiled separately from the submission.
    probe_files: [(&'static str, String); 2],
}

/// Reasons why the reference's parts cannot be compiled. Students cannot fix them.
#[derive(Debug, thiserror::Error)]
pub enum SubstitutionError {
    /// A file cannot be read or written.
    #[error("cannot use {path}: {source}")]
    Io {
        /// Path of the file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The reference does not compile.
    #[error("the reference does not compile: see `cargo check -p reference`")]
    NotCompiled,
}

impl ReferenceParts {
    /// Returns the parts from `cache`, or compiles them if the reference's files or the compiler
    /// have changed.
    pub fn prepare(
        reference: &Path,
        cache: &Path,
        rustc: &Rustc,
    ) -> Result<Self, SubstitutionError> {
        // The course's own code needs no sandbox, and one compile serves all isolation levels.
        let rustc = &Rustc {
            sandbox: Sandbox::none(),
            ..rustc.clone()
        };
        let texts = read(reference, PART_FILES)?;
        let [(_, root), probe, bvh] = read(&reference.join("../substitution"), SCAFFOLD_FILES)?;
        let parts = ReferenceParts {
            folder: cache.join(cache_key(&texts, rustc)),
            scaffold: Scaffold {
                root,
                probe_files: [probe, bvh],
            },
        };
        let folder = &parts.folder;
        if folder.is_dir() {
            return Ok(parts);
        }
        fs::create_dir_all(cache).map_err(io_error(cache))?;
        let work = TempDir::new_in(cache).map_err(io_error(cache))?;
        compile_parts(&texts, work.path(), rustc)?;
        // The folder appears complete or not at all. Another process may have created it first.
        match fs::rename(work.path(), folder) {
            Err(_) if folder.is_dir() => {}
            renamed => renamed.map_err(io_error(folder))?,
        }
        Ok(parts)
    }

    /// Returns a hash of everything that the parts and the scaffold depend on.
    pub fn content_hash(&self) -> ContentHash {
        let folder = ContentHash::default().with(self.folder.as_os_str().as_encoded_bytes());
        let Scaffold {
            root,
            probe_files: asking,
        } = &self.scaffold;
        let texts = asking.iter().map(|(_, text)| text).chain([root]);
        texts.fold(folder, |content, text| content.with(text.as_bytes()))
    }

    fn metadata(&self) -> PathBuf {
        self.folder.join("libparts.rmeta")
    }

    fn library(&self) -> PathBuf {
        self.folder.join("libparts.rlib")
    }
}

fn io_error(path: &Path) -> impl FnOnce(io::Error) -> SubstitutionError {
    let path = path.to_owned();
    move |source| SubstitutionError::Io { path, source }
}

/// Reads these files, in this order.
fn read<const N: usize>(
    folder: &Path,
    names: [&'static str; N],
) -> Result<[(&'static str, String); N], SubstitutionError> {
    let mut texts = names.map(|name| (name, String::new()));
    for (name, text) in &mut texts {
        let path = folder.join(name);
        *text = fs::read_to_string(&path).map_err(io_error(&path))?;
    }
    Ok(texts)
}

/// Returns a hash of everything that the parts depend on: their sources and the compiler.
fn cache_key(texts: &[(&str, String)], rustc: &Rustc) -> String {
    let all = texts.iter().fold(
        ContentHash::default()
            .with(rustc.identity())
            .with(PARTS_ROOT.as_bytes()),
        |content, (name, text)| content.with(name.as_bytes()).with(text.as_bytes()),
    );
    all.hex()
}

fn compile_parts(
    texts: &[(&str, String)],
    folder: &Path,
    rustc: &Rustc,
) -> Result<(), SubstitutionError> {
    let texts = texts.iter().map(|(name, text)| (*name, text.as_str()));
    for (name, text) in texts.chain([("parts.rs", PARTS_ROOT)]) {
        fs::write(folder.join(name), text).map_err(io_error(folder))?;
    }
    let parts = Crate {
        name: "parts",
        kind: CrateKind::Library,
        folder,
        root: "parts.rs",
        links: &[],
        dependency_folder: None,
    };
    match rustc.compile(&parts).map_err(io_error(folder))? {
        CompileOutcome::Done(_) => {}
        CompileOutcome::Errors(_) | CompileOutcome::Failed(_) => {
            return Err(SubstitutionError::NotCompiled);
        }
    }
    // The sources are no longer needed, and they would leave a solution on this machine.
    for name in PART_FILES {
        fs::remove_file(folder.join(name)).map_err(io_error(folder))?;
    }
    Ok(())
}

/// A submission's `bvh.rs`, which is compiled with the reference's parts only if needed.
#[derive(Debug)]
pub struct Substitution {
    /// Source of the submission's `bvh.rs`.
    pub bvh: String,
    /// The parts that replace the submission's other files.
    pub parts: ReferenceParts,
    /// The compiler, which compiles the program on the first request.
    pub rustc: Rustc,
    /// The build folder, which does not exist yet.
    pub folder: PathBuf,
    /// The result of compiling the program, once it has been requested.
    pub program: OnceLock<Option<PathBuf>>,
}

impl Substitution {
    /// Returns the program, or `None` if it does not compile, for example because `bvh.rs` uses
    /// helpers in the submission's other files.
    pub fn program(&self) -> io::Result<Option<&Path>> {
        if self.program.get().is_none() {
            let program = self.compile()?;
            self.program.get_or_init(|| program);
        }
        Ok(self.program.get().and_then(Option::as_deref))
    }

    fn compile(&self) -> io::Result<Option<PathBuf>> {
        let content = self.parts.content_hash().with(self.bvh.as_bytes());
        Ok(
            match self
                .rustc
                .compile_cached(&content, || self.compile_uncached())?
            {
                CompileOutcome::Done(program) => Some(program),
                CompileOutcome::Errors(errors)
                    if errors.iter().any(|error| error.blamed_file().is_some()) =>
                {
                    None
                }
                CompileOutcome::Errors(_) | CompileOutcome::Failed(_) => {
                    self.check_starter()?;
                    None
                }
            },
        )
    }

    /// Compiles the starter's `bvh.rs` with the parts. This is done when no error explains why the
    /// submission's file does not compile: if the starter's does not compile either, the machine is
    /// to blame.
    fn check_starter(&self) -> io::Result<()> {
        let [.., bvh] = TASK_FILES;
        let starter = Substitution {
            bvh: bvh.starter.to_owned(),
            parts: self.parts.clone(),
            rustc: self.rustc.clone(),
            folder: self.folder.with_extension("starter"),
            program: OnceLock::new(),
        };
        let why = match starter.compile_uncached()? {
            CompileOutcome::Done(_) => return Ok(()),
            CompileOutcome::Errors(errors) => errors[0].text().to_owned(),
            CompileOutcome::Failed(why) => why,
        };
        Err(io::Error::other(format!(
            "not even the starter's bvh.rs compiles with the reference's parts: {why}"
        )))
    }

    fn compile_uncached(&self) -> io::Result<CompileOutcome> {
        fs::create_dir_all(&self.folder)?;
        let Scaffold {
            root,
            probe_files: asking,
        } = &self.parts.scaffold;
        fs::write(self.folder.join("around.rs"), root)?;
        fs::write(self.folder.join("bvh.rs"), &self.bvh)?;
        let submission = self.rustc.compile(&Crate {
            name: "submission",
            kind: CrateKind::Library,
            folder: &self.folder,
            root: "around.rs",
            links: &[("parts", &self.parts.metadata())],
            dependency_folder: None,
        })?;
        let submission = match submission {
            CompileOutcome::Done(library) => library,
            failed @ (CompileOutcome::Errors(_) | CompileOutcome::Failed(_)) => return Ok(failed),
        };

        let joined = self.folder.join("joined");
        fs::create_dir_all(&joined)?;
        let world = GIVEN_FILES
            .into_iter()
            .filter(|(name, _)| *name == "world.rs");
        let asking = asking.iter().map(|(name, text)| (*name, text.as_str()));
        for (name, text) in world.chain(asking) {
            fs::write(joined.join(name), text)?;
        }
        self.rustc.compile(&Crate {
            name: "probe",
            kind: CrateKind::Program,
            folder: &joined,
            root: "probe.rs",
            links: &[
                ("submission", &submission),
                ("parts", &self.parts.library()),
            ],
            dependency_folder: Some(&self.parts.folder),
        })
    }
}
