//! Calls `rustc` directly instead of through Cargo, so that no manifest, build script or
//! configuration in a submission is read, and the modification times of the submission's files
//! don't matter.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use judging::content_hash::ContentHash;
use tempfile::TempDir;

use crate::build::compile_budget::{CompileBudget, CompileTime, used_up_message};
use crate::build::compiler_sandbox;
use crate::build::dependencies::Dependencies;
use crate::build::diagnostics::{self, Diagnostic, WARNINGS};
use crate::build::linker::option_with_path;
use crate::build::machine_fault::{KILLED, check_disk, is_killed};
use crate::build::source_crate::{CompileOutcome, Crate, CrateKind};
use crate::build::toolchain::Toolchain;
use crate::build::verified_copy::{self, OutputFile};
use crate::machine::capture::Capture;
use crate::machine::run_permit::decide;
use crate::machine::system::{self, Limits};
use crate::sandbox::{ExitReason, Sandbox};

const LIMITS: Limits = Limits {
    memory: 4 << 30,
    data: None,
    cpu: CompileTime::MOST.cpu,
    file: 256 << 20,
};
/// The memory that a correct submission may need, in bytes.
const NEEDED_MEMORY: u64 = 512 << 20;
/// Maximum size of the compiler messages that are stored, in bytes.
const MAX_MESSAGE_BYTES: usize = 1 << 20;

/// The message to show if the compiler is killed even when nothing else is running.
const KILLED_ALONE: &str = "the system killed the compiler (signal 9) twice, the second time while \
    nothing else was running; a different program does compile, so this code makes the compiler \
    use too much memory";

/// Result of an attempt to compile.
#[derive(Debug)]
enum CompileAttempt {
    /// An outcome that wasn't caused by the machine.
    Certain(CompileOutcome),
    /// The compiler failed without an error that says why.
    Unexplained(CompileOutcome),
    /// The system killed the compiler or the linker, and no error names one of the submission's
    /// files.
    Killed,
}

/// The compiler and everything it needs to compile a submission.
#[derive(Clone, Debug)]
pub struct Rustc {
    /// The toolchain, which contains the compiler.
    pub toolchain: Toolchain,
    /// The crates that everything is linked with.
    pub dependencies: Dependencies,
    /// The cache of compiled programs, keyed by the hashes of their inputs. It is for tools that
    /// build the same submissions repeatedly. `None` for normal grading, which always compiles.
    pub cache: Option<PathBuf>,
    /// The sandbox that the compiler runs in. Programs are linked so that they can run in it.
    pub sandbox: Sandbox,
    /// The remaining time for a submission. `None` for the course's own code, where every failure
    /// is caused by the machine.
    pub(super) budget: Option<CompileBudget>,
}

impl Rustc {
    /// Returns a compiler for the course's own code, without a cache or a sandbox.
    pub(super) fn new(toolchain: Toolchain, dependencies: Dependencies) -> Self {
        Rustc {
            toolchain,
            dependencies,
            cache: None,
            sandbox: Sandbox::none(),
            budget: None,
        }
    }

    /// Returns bytes that identify everything that the compiler's output depends on, apart from the
    /// sources.
    pub fn identity(&self) -> &[u8] {
        // The folder's name is a hash of the compiler and the dependencies' sources.
        self.dependencies.folder.as_os_str().as_encoded_bytes()
    }

    /// Returns the program with this hash from the cache. If it isn't cached, compiles and stores
    /// it.
    pub fn compile_cached(
        &self,
        content: &ContentHash,
        compile: impl FnOnce() -> io::Result<CompileOutcome>,
    ) -> io::Result<CompileOutcome> {
        let Some(cache) = &self.cache else {
            return compile();
        };
        let kept = cache.join(content.hex());
        if kept.is_file() {
            // Tools that use the cache don't show warnings.
            let warnings = Vec::new();
            return Ok(CompileOutcome::Done {
                path: kept,
                warnings,
            });
        }
        let compiled = compile()?;
        let CompileOutcome::Done { path, warnings } = compiled else {
            return Ok(compiled);
        };
        // Move the file instead of copying it, so that it is always complete and never executed
        // while open for writing.
        fs::rename(path, &kept)?;
        Ok(CompileOutcome::Done {
            path: kept,
            warnings,
        })
    }

    /// Returns a compiler for one submission.
    pub(super) fn for_submission(&self) -> Self {
        Rustc {
            budget: Some(CompileBudget::default()),
            ..self.clone()
        }
    }

    /// Returns a compiler for the course's own code.
    pub(super) fn for_own_code(&self) -> Self {
        Rustc {
            budget: None,
            ..self.clone()
        }
    }

    /// Compiles one crate. A failure of the machine is returned as an error rather than an outcome.
    ///
    /// If the compiler fails on a submission without an error that explains why, the crate is
    /// compiled again while this process runs nothing else. If the system kills the compiler again
    /// but the control program compiles, the crate is to blame. For all other unexplained failures,
    /// the starter is compiled for comparison once nothing else is left to try.
    pub fn compile(&self, source: &Crate) -> io::Result<CompileOutcome> {
        let attempt = match self.budget {
            Some(_) => decide(
                || self.attempt(source),
                |attempt| !matches!(attempt, CompileAttempt::Certain(_)),
                |attempt| match attempt {
                    CompileAttempt::Certain(_) | CompileAttempt::Unexplained(_) => Ok(()),
                    CompileAttempt::Killed => self.compile_honest(source.folder).map(drop),
                },
            )?,
            None => self.attempt(source)?,
        };
        match attempt {
            CompileAttempt::Killed => match self.budget {
                Some(_) => Ok(CompileOutcome::Failed(KILLED_ALONE.to_owned())),
                None => Err(io::Error::other(KILLED)),
            },
            CompileAttempt::Certain(outcome) | CompileAttempt::Unexplained(outcome) => {
                if outcome.is_unexplained() {
                    check_disk(source.folder)?;
                }
                Ok(outcome)
            }
        }
    }

    /// Compiles the control program in a new folder next to `folder`. The result shows whether the
    /// machine is the reason for a failure. Returns the program and a guard that removes its folder
    /// when dropped.
    pub(super) fn compile_honest(&self, folder: &Path) -> io::Result<(TempDir, PathBuf)> {
        const NAME: &str = "control";
        const SOURCE: &str = include_str!("../../trial/control.rs");
        let folder = TempDir::new_in(folder.parent().unwrap_or(folder))?;
        let outcome = self.compile_text(folder.path(), NAME, SOURCE, CrateKind::Program)?;
        let program = outcome.into_result().map_err(io::Error::other)?;
        Ok((folder, program))
    }

    /// Compiles one of the grader's own programs or libraries in a new folder inside `work`.
    pub(super) fn compile_text(
        &self,
        work: &Path,
        name: &str,
        text: &str,
        kind: CrateKind,
    ) -> io::Result<CompileOutcome> {
        let folder = work.join(name);
        let root = format!("{name}.rs");
        fs::create_dir(&folder)?;
        fs::write(folder.join(&root), text)?;
        let own = self.for_own_code();
        own.compile(&Crate::new(name, kind, &folder, &root))
    }

    /// Attempts to compile one crate.
    fn attempt(&self, source: &Crate) -> io::Result<CompileAttempt> {
        let Some(time) = self.time_left() else {
            return Ok(stopped());
        };
        let mut command = Command::new(&self.toolchain.rustc);
        system::clear_environment(&mut command);
        system::keep_search_path(&mut command);
        command
            .env("TMPDIR", source.folder)
            .args(FLAGS)
            .args(WARNINGS.map(|lint| format!("--force-warn={lint}")))
            .args(self.link_arguments(source))
            .args(["--crate-name", source.name])
            .args(match source.kind {
                CrateKind::Program => ["--crate-type=bin", "--emit=link"],
                CrateKind::Library => ["--crate-type=rlib", "--emit=metadata,link"],
            })
            .arg(source.root);
        match source.kind {
            CrateKind::Program => {
                let (linker, sysroot) = (&self.toolchain.linker, self.toolchain.sysroot());
                let is_readable = |program: &Path| {
                    !self.sandbox.confines() || compiler_sandbox::can_read_program(sysroot, program)
                };
                linker.arguments(sysroot, source.folder, is_readable, &mut command)?;
            }
            CrateKind::Library => {}
        }
        if self.sandbox.confines() {
            compiler_sandbox::arguments(self.toolchain.sysroot(), source, &mut command);
        }
        let profile =
            compiler_sandbox::profile(self.toolchain.sysroot(), &self.dependencies, source);
        let limits = Limits {
            cpu: time.cpu,
            ..LIMITS.within_available_memory(NEEDED_MEMORY)
        };
        let started_at = Instant::now();
        let mut process = self
            .sandbox
            .start(command, source.folder, profile, limits)?;
        let messages = Capture::start(
            process.child.stderr.take().expect("the stream is piped"),
            MAX_MESSAGE_BYTES,
        );

        let deadline = started_at + time.wall;
        let mut cpu = None;
        let exit_reason = loop {
            // The compiler's CPU time is only available until its exit code has been read.
            cpu = process.cpu_time_with_children().or(cpu);
            match process.exit_reason() {
                Some(exit_reason) => break Some(exit_reason),
                None if Instant::now() >= deadline => {
                    process.kill();
                    break None;
                }
                // The compiler closes its output just before it ends, so there is no need to poll
                // before that.
                None => messages.wait_for_end(deadline.saturating_duration_since(Instant::now())),
            }
            thread::sleep(Duration::from_micros(200));
        };
        let wall = started_at.elapsed();
        if let Some(budget) = &self.budget {
            let cpu = cpu.unwrap_or(wall);
            budget.spend(CompileTime { cpu, wall });
        }
        let Some(exit_reason) = exit_reason else {
            return Ok(stopped());
        };
        messages.wait_for_end(Duration::from_secs(1));

        if exit_reason.is_success() {
            return Ok(CompileAttempt::Certain(match self.output_file(source)? {
                OutputFile::Verified(path) => CompileOutcome::Done {
                    path,
                    warnings: diagnostics::warnings(&messages.head()),
                },
                OutputFile::TooLarge(bytes) => CompileOutcome::Failed(too_large_message(bytes)),
                OutputFile::Missing => CompileOutcome::Failed(failure_message(exit_reason)),
            }));
        }
        let errors = diagnostics::errors(&messages.head());
        if errors.iter().any(Diagnostic::is_about_source) {
            return Ok(CompileAttempt::Certain(CompileOutcome::Errors(errors)));
        }
        if is_killed(exit_reason, &errors) {
            return Ok(CompileAttempt::Killed);
        }
        if exit_reason.is_time_limit() || self.time_left().is_none() {
            return Ok(stopped());
        }
        Ok(CompileAttempt::Unexplained(if errors.is_empty() {
            CompileOutcome::Failed(failure_message(exit_reason))
        } else {
            CompileOutcome::Errors(errors)
        }))
    }

    /// Returns the remaining time for compiling, or `None` if it is used up.
    fn time_left(&self) -> Option<CompileTime> {
        match &self.budget {
            Some(budget) => budget.left(),
            None => Some(CompileTime::MOST),
        }
    }

    /// Returns the compiler's output. Its size limit is the same with and without a sandbox, so
    /// that a submission gets the same result everywhere.
    fn output_file(&self, source: &Crate) -> io::Result<OutputFile> {
        let name = source.kind.file_name(source.name);
        if self.sandbox.confines() {
            verified_copy::copy_verified(source.folder, &name)
        } else {
            verified_copy::check_size(source.folder.join(name))
        }
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

/// Returns the result of an attempt that ran out of time.
fn stopped() -> CompileAttempt {
    CompileAttempt::Certain(CompileOutcome::Failed(used_up_message()))
}

fn too_large_message(bytes: u64) -> String {
    format!(
        "the compiled program is {} MiB, but the limit is {} MiB: make its `static` variables and \
         constants smaller, or fill them at run time",
        bytes.div_ceil(1 << 20),
        verified_copy::MAX_BYTES >> 20
    )
}

fn failure_message(exit_reason: ExitReason) -> String {
    match exit_reason {
        ExitReason::Code(0) => "the compiler reported no error but produced no program".to_owned(),
        ExitReason::Code(code) => format!("the compiler exited with code {code}"),
        ExitReason::Signal(signal) => format!(
            "the compiler was killed by signal {signal}: it used too much time or memory, or crashed on this code"
        ),
    }
}

/// Compiler flags. They are the same for students, TAs and CI.
const FLAGS: [&str; 11] = [
    "--edition=2024",
    "-Copt-level=2",
    // Two threads each optimise half of the code. Inlining across the halves (`lto`) would take
    // more processor time than optimising all of the code at once.
    "-Ccodegen-units=2",
    "-Clto=off",
    "-Cdebuginfo=0",
    // The crates have no debug info, and copying the standard library's would take a third of the
    // linking time.
    "-Cstrip=debuginfo",
    "-Coverflow-checks=on",
    "-Cpanic=unwind",
    "-Funsafe_code",
    "-Awarnings",
    "--error-format=json",
];
