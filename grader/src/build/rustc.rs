//! One direct call of `rustc`: no manifest, build script, configuration or fingerprint beside a
//! submission is ever read, and its files' times mean nothing.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use crate::build::confined;
use crate::build::dependencies::Dependencies;
use crate::build::diagnostics::{self, Diagnostic};
use crate::build::kept::{Content, Kept};
use crate::build::lacking::Lacking;
use crate::build::linker;
use crate::build::taken;
use crate::build::toolchain::Toolchain;
use crate::capture::Capture;
use crate::sandbox::{Ending, Sandbox};
use crate::system::{self, Limits};

const LIMITS: Limits = Limits {
    memory: 4 << 30,
    cpu: Duration::from_secs(60),
    file: 256 << 20,
};
/// The back-stop for a compiler that waits instead of working.
const WALL: Duration = Duration::from_secs(90);
/// How much is kept of what the compiler says.
const KEPT: usize = 1 << 20;

/// A crate to compile.
#[derive(Debug)]
pub struct Crate<'a> {
    /// What others call it.
    pub name: &'a str,
    /// What is made of it.
    pub kind: Kind,
    /// Where its sources lie, and what is made of them.
    pub folder: &'a Path,
    /// The file in the folder that holds its root module.
    pub root: &'a str,
    /// The crates that it may name, beside those that every submission may.
    pub links: &'a [(&'a str, &'a Path)],
    /// The folder with what those need in turn, beside what every submission needs.
    pub behind: Option<&'a Path>,
}

/// What is made of a crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An executable.
    Program,
    /// An `rlib`, and the metadata that suffices to compile against it.
    Library,
}

impl Kind {
    /// What the compiler calls its file.
    fn file(self, name: &str) -> String {
        match self {
            Kind::Program => format!("{name}{}", std::env::consts::EXE_SUFFIX),
            Kind::Library => format!("lib{name}.rlib"),
        }
    }
}

/// What became of one call of the compiler.
#[derive(Debug)]
pub enum Compiled {
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
    pub kept: Option<Kept>,
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
    pub fn once(
        &self,
        content: &Content,
        compile: impl FnOnce() -> io::Result<Compiled>,
    ) -> io::Result<Compiled> {
        let Some(kept) = &self.kept else {
            return compile();
        };
        if let Some(program) = kept.find(content) {
            return Ok(Compiled::Done(program));
        }
        Ok(match compile()? {
            Compiled::Done(program) => Compiled::Done(kept.keep(content, &program)?),
            other @ (Compiled::Errors(_) | Compiled::Failed(_)) => other,
        })
    }

    /// Compiles one crate. What the machine lacks for that is an error, and no fault of the crate's.
    pub fn compile(&self, source: &Crate) -> io::Result<Compiled> {
        let mut command = Command::new(&self.toolchain.rustc);
        system::clear_environment(&mut command);
        command
            .env("PATH", std::env::var_os("PATH").unwrap_or_default())
            .env("TMPDIR", source.folder)
            .args(FLAGS)
            .args(self.links(source))
            .args(["--crate-name", source.name])
            .args(match source.kind {
                Kind::Program => ["--crate-type=bin", "--emit=link"],
                Kind::Library => ["--crate-type=rlib", "--emit=metadata,link"],
            })
            .arg(source.root);
        match source.kind {
            Kind::Program => {
                linker::arguments(self.toolchain.sysroot(), source.folder, &mut command)?;
            }
            Kind::Library => {}
        }
        if self.sandbox.confines() {
            confined::arguments(self, source, &mut command);
        }
        let profile = confined::profile(self, source);
        let mut process = self
            .sandbox
            .start(command, source.folder, profile, LIMITS)?;
        let messages = Capture::start(process.child.stderr.take().expect("it is piped"), KEPT);

        let deadline = Instant::now() + WALL;
        let ending = loop {
            match process.ending() {
                Some(ending) => break ending,
                None if Instant::now() >= deadline => {
                    process.kill();
                    let seconds = WALL.as_secs();
                    return Ok(Compiled::Failed(format!(
                        "the compiler was stopped after {seconds} s"
                    )));
                }
                // Its last words come just before its end, and until then there is nothing to see.
                None => messages.settle(deadline.saturating_duration_since(Instant::now())),
            }
            thread::sleep(Duration::from_micros(200));
        };
        messages.settle(Duration::from_secs(1));

        if ending.is_success()
            && let Some(made) = self.made(source)?
        {
            return Ok(Compiled::Done(made));
        }
        let errors = diagnostics::errors(&messages.head());
        Lacking::check(ending, &errors, source.folder).map_err(io::Error::other)?;
        Ok(if errors.is_empty() {
            Compiled::Failed(failure(ending))
        } else {
            Compiled::Errors(errors)
        })
    }

    /// What was made, if it was.
    fn made(&self, source: &Crate) -> io::Result<Option<PathBuf>> {
        let name = source.kind.file(source.name);
        if self.sandbox.confines() {
            return taken::take(source.folder, &name);
        }
        let path = source.folder.join(name);
        Ok(path.is_file().then_some(path))
    }

    fn links(&self, source: &Crate) -> Vec<OsString> {
        let mut arguments = Vec::new();
        for folder in [self.dependencies.folder.as_path()]
            .into_iter()
            .chain(source.behind)
        {
            arguments.push(joined("-Ldependency=", folder));
        }
        let common = self.dependencies.externs.iter();
        let common = common.map(|(name, rlib)| (name.as_str(), rlib.as_path()));
        for (name, library) in common.chain(source.links.iter().copied()) {
            arguments.extend(["--extern".into(), joined(&format!("{name}="), library)]);
        }
        arguments
    }
}

fn joined(option: &str, path: &Path) -> OsString {
    let mut argument = OsString::from(option);
    argument.push(path);
    argument
}

fn failure(ending: Ending) -> String {
    match ending {
        Ending::Code(code) => format!("the compiler ended with exit code {code}"),
        Ending::Signal(signal) => format!(
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
