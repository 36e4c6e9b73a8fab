//! A submission's `bvh.rs` on parts that are known to be right: so that a mistake in a box test
//! does not cost the points of walking a tree.
//!
//! Those parts are the reference's other four files, compiled once. Of them the submission's
//! compile sees the metadata alone; they are joined in a step that reads none of its text. The
//! reference's own `bvh.rs` is not among them: in the place of the submission's `build` stands a
//! plain one of ours, so that a mistake in building does not cost the points of walking either.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use tempfile::TempDir;

use crate::build::program_cache::ContentHash;
use crate::build::rustc::{CompileOutcome, Crate, CrateKind, Rustc};
use crate::given_files::{GIVEN_FILES, TASK_FILES};
use crate::sandbox::Sandbox;

/// The reference's files that make up the parts, in the order of their dependence.
const PART_FILES: [&str; 5] = [
    "camera.rs",
    "bbox.rs",
    "triangle.rs",
    "sphere.rs",
    "primitive.rs",
];

/// Their root.
const PARTS_ROOT: &str = "
pub mod bbox;
pub mod camera;
pub mod primitive;
pub mod sphere;
pub mod triangle;
";
/// What stands around the submission's `bvh.rs`, beside the reference's files and not in this
/// program: students have it too, and the plain `build` is not for them.
const SCAFFOLD_FILES: [&str; 3] = ["around.rs", "probe.rs", "bvh.rs"];

/// The compiled parts, and what stands around the submission on them.
#[derive(Clone, Debug)]
pub struct ReferenceParts {
    folder: PathBuf,
    scaffold: Scaffold,
}

/// Two crates of ours.
#[derive(Clone, Debug)]
struct Scaffold {
    /// The root of the crate that the submission's `bvh.rs` finds itself in.
    root: String,
    /// The files of the crate that asks it, compiled apart from the submission's text.
    probe_files: [(&'static str, String); 2],
}

/// The reference, from which the parts are made, is not as it should be: not a student's fault.
#[derive(Debug, thiserror::Error)]
pub enum SubstitutionError {
    /// A file can not be read or written.
    #[error("can not use {path}: {source}")]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// The compiler refuses them.
    #[error("the reference does not compile: see `cargo check -p reference`")]
    NotCompiled,
}

impl ReferenceParts {
    /// Those made earlier from the same files, or newly made ones, kept below `cache`.
    pub fn prepare(
        reference: &Path,
        cache: &Path,
        rustc: &Rustc,
    ) -> Result<Self, SubstitutionError> {
        // Our own text, compiled once for all levels.
        let rustc = &Rustc {
            sandbox: Sandbox::none(),
            ..rustc.clone()
        };
        let texts = read(reference, PART_FILES)?;
        let [(_, root), probe, bvh] = read(&reference.join("../carried"), SCAFFOLD_FILES)?;
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
        // Complete or not at all. Somebody else may have been faster with the same.
        match fs::rename(work.path(), folder) {
            Err(_) if folder.is_dir() => {}
            renamed => renamed.map_err(io_error(folder))?,
        }
        Ok(parts)
    }

    /// All that they follow from, and what stands around a submission on them.
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

/// The texts of these files, in their order.
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

/// What the parts follow from: their texts, and what they are compiled with.
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
    // Compiled, the texts are of no more use here, and would only be a solution left lying about.
    for name in PART_FILES {
        fs::remove_file(folder.join(name)).map_err(io_error(folder))?;
    }
    Ok(())
}

/// A submission's `bvh.rs`, to be compiled on the parts if it ever comes to that.
#[derive(Debug)]
pub struct Substitution {
    /// Its text.
    pub bvh: String,
    /// What takes the place of its other files.
    pub parts: ReferenceParts,
    /// What compiles it.
    pub rustc: Rustc,
    /// Where; not there yet.
    pub folder: PathBuf,
    /// The program, once it was asked for.
    pub program: OnceLock<Option<PathBuf>>,
}

impl Substitution {
    /// The program. None if it does not compile there, such as one that calls helpers of the
    /// submission's other files.
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

    /// Compiles the starter's `bvh.rs` in its place, where nothing says why the submission's does not
    /// compile: if that does not either, the machine is to blame.
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
            "not even the file that was handed out compiles on the reference's parts: {why}"
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
