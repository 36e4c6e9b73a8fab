//! One direct call of `rustc`: no manifest, build script, configuration or fingerprint beside a
//! submission is ever read, and its files' times mean nothing.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use crate::build::compiler_sandbox;
use crate::build::dependencies::Dependencies;
use crate::build::diagnostics::{self, Diagnostic};
use crate::build::linker;
use crate::build::machine_fault::MachineFault;
use crate::build::program_cache::{ContentHash, ProgramCache};
use crate::build::toolchain::Toolchain;
use crate::build::verified_copy;
use crate::capture::Capture;
use crate::sandbox::{ExitReason, Sandbox};
use crate::system::{self, Limits};

const LIMITS: Limits = Limits {
    memory: 4 << 30,
    cpu: Duration::from_secs(60),
    file: 256 << 20,
};
/// The back-stop for a compiler that waits instead of working.
const WALL_LIMIT: Duration = Duration::from_secs(90);
/// How much is kept of what the compiler says.
const MAX_MESSAGE_BYTES: usize = 1 << 20;

/// A crate to compile.
#[derive(Debug)]
pub struct Crate<'a> {
    /// What others call it.
    pub name: &'a str,
    /// What is made of it.
    pub kind: CrateKind,
    /// Where its sources lie, and what is made of them.
    pub folder: &'a Path,
    /// The file in the folder that holds its root module.
    pub root: &'a str,
    /// The crates that it may name, beside those that every submission may.
    pub links: &'a [(&'a str, &'a Path)],
    /// The folder with what those need in turn, beside what every submission needs.
    pub dependency_folder: Option<&'a Path>,
}

/// What is made of a crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CrateKind {
    /// An executable.
    Program,
    /// An `rlib`, and the metadata that suffices to compile against it.
    Library,
}

impl CrateKind {
    /// What the compiler calls its file.
    fn file_name(self, name: &str) -> String {
        match self {
            CrateKind::Program => format!("{name}{}", std::env::consts::EXE_SUFFIX),
            CrateKind::Library => format!("lib{name}.rlib"),
        }
    }
}

/// What became of one call of the compiler.
#[derive(Debug)]
pub enum CompileOutcome {
    /// The program or library.
    Done(PathBuf),
    /// Errors.
    Errors(Vec<Diagnostic>),
    /// The compiler did not come to an end by itself, or said nothing that we understand.
    Failed(String),
}

/// What submissions are compiled with.
#[derive(Clone, Debug)]
pub struct Rustc {
    /// The compiler.
    pub toolchain: Toolchain,
    /// What everything is linked with.
    pub dependencies: Dependencies,
    /// What was compiled before, for whoever wants it again.
    pub cache: Option<ProgramCache>,
    /// How the compiler is kept apart, and programs are linked for.
    pub sandbox: Sandbox,
}

impl Rustc {
    /// What everything that it makes follows from, beside the sources.
    pub fn identity(&self) -> &[u8] {
        // The folder is named after the compiler and the dependencies' sources.
        self.dependencies.folder.as_os_str().as_encoded_bytes()
    }

    /// The program of this content, compiled unless it is kept from an earlier time.
    pub fn compile_cached(
        &self,
        content: &ContentHash,
        compile: impl FnOnce() -> io::Result<CompileOutcome>,
    ) -> io::Result<CompileOutcome> {
        let Some(kept) = &self.cache else {
            return compile();
        };
        if let Some(program) = kept.find(content) {
            return Ok(CompileOutcome::Done(program));
        }
        Ok(match compile()? {
            CompileOutcome::Done(program) => CompileOutcome::Done(kept.store(content, &program)?),
            other @ (CompileOutcome::Errors(_) | CompileOutcome::Failed(_)) => other,
        })
    }

    /// Compiles one crate. What the machine lacks for that is an error, and no fault of the crate's.
    pub fn compile(&self, source: &Crate) -> io::Result<CompileOutcome> {
        let mut command = Command::new(&self.toolchain.rustc);
        system::clear_environment(&mut command);
        command
            .env("PATH", std::env::var_os("PATH").unwrap_or_default())
            .env("TMPDIR", source.folder)
            .args(FLAGS)
            .args(self.link_arguments(source))
            .args(["--crate-name", source.name])
            .args(match source.kind {
                CrateKind::Program => ["--crate-type=bin", "--emit=link"],
                CrateKind::Library => ["--crate-type=rlib", "--emit=metadata,link"],
            })
            .arg(source.root);
        match source.kind {
            CrateKind::Program => {
                linker::arguments(self.toolchain.sysroot(), source.folder, &mut command)?;
            }
            CrateKind::Library => {}
        }
        if self.sandbox.confines() {
            compiler_sandbox::arguments(self, source, &mut command);
        }
        let profile = compiler_sandbox::profile(self, source);
        let mut process = self
            .sandbox
            .start(command, source.folder, profile, LIMITS)?;
        let messages = Capture::start(
            process.child.stderr.take().expect("it is piped"),
            MAX_MESSAGE_BYTES,
        );

        let deadline = Instant::now() + WALL_LIMIT;
        let ending = loop {
            match process.exit_reason() {
                Some(ending) => break ending,
                None if Instant::now() >= deadline => {
                    process.kill();
                    let seconds = WALL_LIMIT.as_secs();
                    return Ok(CompileOutcome::Failed(format!(
                        "the compiler was stopped after {seconds} s"
                    )));
                }
                // Its last words come just before its end, and until then there is nothing to see.
                None => messages.wait_for_end(deadline.saturating_duration_since(Instant::now())),
            }
            thread::sleep(Duration::from_micros(200));
        };
        messages.wait_for_end(Duration::from_secs(1));

        if ending.is_success()
            && let Some(made) = self.output_file(source)?
        {
            return Ok(CompileOutcome::Done(made));
        }
        let errors = diagnostics::errors(&messages.head());
        MachineFault::check(ending, &errors, source.folder).map_err(io::Error::other)?;
        Ok(if errors.is_empty() {
            CompileOutcome::Failed(failure_message(ending))
        } else {
            CompileOutcome::Errors(errors)
        })
    }

    /// What was made, if it was.
    fn output_file(&self, source: &Crate) -> io::Result<Option<PathBuf>> {
        let name = source.kind.file_name(source.name);
        if self.sandbox.confines() {
            return verified_copy::copy_verified(source.folder, &name);
        }
        let path = source.folder.join(name);
        Ok(path.is_file().then_some(path))
    }

    fn link_arguments(&self, source: &Crate) -> Vec<OsString> {
        let mut arguments = Vec::new();
        for folder in [self.dependencies.folder.as_path()]
            .into_iter()
            .chain(source.dependency_folder)
        {
            arguments.push(option_with_path("-Ldependency=", folder));
        }
        let common = self.dependencies.externs.iter();
        let common = common.map(|(name, rlib)| (name.as_str(), rlib.as_path()));
        for (name, library) in common.chain(source.links.iter().copied()) {
            arguments.extend([
                "--extern".into(),
                option_with_path(&format!("{name}="), library),
            ]);
        }
        arguments
    }
}

fn option_with_path(option: &str, path: &Path) -> OsString {
    let mut argument = OsString::from(option);
    argument.push(path);
    argument
}

fn failure_message(ending: ExitReason) -> String {
    match ending {
        ExitReason::Code(code) => format!("the compiler ended with exit code {code}"),
        ExitReason::Signal(signal) => format!(
            "the compiler was ended by signal {signal}: too much time or memory, or code that it can not digest"
        ),
    }
}

/// The same for everyone: students, TAs, CI.
const FLAGS: [&str; 10] = [
    "--edition=2024",
    "-Copt-level=2",
    "-Ccodegen-units=1",
    "-Cdebuginfo=0",
    // Ours is none, and copying that of the standard library is a third of the linking.
    "-Cstrip=debuginfo",
    "-Coverflow-checks=on",
    "-Cpanic=unwind",
    "-Funsafe_code",
    "-Awarnings",
    "--error-format=json",
];
