//! Whether a sandbox holds on this machine: not what the system says of itself, but what comes of
//! trying, with the profiles of submissions. What can not be tried does not hold.

use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::build::Builder;
use crate::build::build_dir::BuildDir;
use crate::build::rustc::{CompileOutcome, Crate, CrateKind, Rustc};
use crate::capture::Capture;
use crate::sandbox::{Isolation, Profile};
use crate::system::{self, Limits};

/// Tries what no submission may do.
const ATTACK_PROGRAM: &str = include_str!("../../trial/attempts.rs");
/// Its last line.
const END: &str = "end";
/// Nothing that anybody could guess to have been in the file.
const SECRET: &str = "planted, to be read by nobody";

const LIMITS: Limits = Limits {
    memory: 1 << 30,
    cpu: Duration::from_secs(10),
    file: 0,
};
/// A trial takes milliseconds, unless the machine is very busy.
const WALL_LIMIT: Duration = Duration::from_secs(30);

/// Why a level of isolation is not reached here.
#[derive(Debug, thiserror::Error)]
pub enum SelfTestError {
    /// A part of it can not be put in place.
    #[error("{0}")]
    Setup(io::Error),
    /// The compiler does not work in it.
    #[error("a program can not be compiled and linked statically in it: {0}")]
    NotCompiled(String),
    /// The compiler reads what it should not.
    #[error("a submission's compiler can read other files")]
    CompilerCanRead,
    /// A program does what it should not.
    #[error("a submission can {0}")]
    ProgramCan(String),
    /// The program that should have tried did not come to its end.
    #[error("a program that tried what is forbidden did not end well: {0}")]
    Incomplete(String),
}

impl Builder {
    /// Tries out the sandbox that submissions are built and asked in.
    pub fn test_sandbox(&self) -> Result<(), SelfTestError> {
        let work = BuildDir::new_in(&self.folder).map_err(SelfTestError::Setup)?;
        // Where every user of the machine could read it, were it not for the sandbox.
        let place = TempDir::new().map_err(SelfTestError::Setup)?;
        let key = place.path().join("key");
        system::make_folder_accessible(place.path()).map_err(SelfTestError::Setup)?;
        fs::write(&key, SECRET).map_err(SelfTestError::Setup)?;

        let program = compile(
            &self.rustc,
            work.path(),
            "attempts",
            ATTACK_PROGRAM,
            CrateKind::Program,
        )?;
        let program = match program {
            CompileOutcome::Done(program) => program,
            CompileOutcome::Errors(errors) => {
                return Err(SelfTestError::NotCompiled(errors[0].text().to_owned()));
            }
            CompileOutcome::Failed(why) => return Err(SelfTestError::NotCompiled(why)),
        };
        // At this level, nothing keeps the compiler from reading what its user may.
        if self.rustc.sandbox.level() > Isolation::SeccompOnly {
            let reads = format!("pub const KEY: &str = include_str!({key:?});");
            match compile(
                &self.rustc,
                work.path(),
                "reads",
                &reads,
                CrateKind::Library,
            )? {
                CompileOutcome::Errors(errors) if !errors[0].text().contains(SECRET) => {}
                CompileOutcome::Done(_) | CompileOutcome::Errors(_) | CompileOutcome::Failed(_) => {
                    return Err(SelfTestError::CompilerCanRead);
                }
            }
        }
        let said = run(&self.rustc, &program, &key)?;
        match said.lines().next() {
            Some(END) => Ok(()),
            Some(what) if said.ends_with("end\n") => {
                Err(SelfTestError::ProgramCan(what.to_owned()))
            }
            Some(_) | None => Err(SelfTestError::Incomplete(said)),
        }
    }
}

fn compile(
    rustc: &Rustc,
    work: &Path,
    name: &str,
    text: &str,
    kind: CrateKind,
) -> Result<CompileOutcome, SelfTestError> {
    let folder = work.join(name);
    let root = format!("{name}.rs");
    let compiled = fs::create_dir(&folder)
        .and_then(|()| fs::write(folder.join(&root), text))
        .and_then(|()| {
            rustc.compile(&Crate {
                name,
                kind,
                folder: &folder,
                root: &root,
                links: &[],
                dependency_folder: None,
            })
        });
    compiled.map_err(SelfTestError::Setup)
}

/// What the program says, on both streams.
fn run(rustc: &Rustc, program: &Path, key: &Path) -> Result<String, SelfTestError> {
    let mut command = Command::new(program);
    system::clear_environment(&mut command);
    let folder = program.parent().unwrap_or(Path::new("."));
    let process = rustc.sandbox.start(command, folder, Profile::Probe, LIMITS);
    let mut process = process.map_err(SelfTestError::Setup)?;
    let stdout = process.child.stdout.take().expect("it is piped");
    let stderr = process.child.stderr.take().expect("it is piped");
    let (said, complained) = (
        Capture::start(stdout, 1 << 16),
        Capture::start(stderr, 1 << 16),
    );
    let mut stdin = process.child.stdin.take().expect("it is piped");
    // If it has ended already, its words say why.
    writeln!(stdin, "{}", key.display()).ok();

    let deadline = Instant::now() + WALL_LIMIT;
    while process.exit_reason().is_none() && Instant::now() < deadline {
        thread::sleep(Duration::from_millis(1));
    }
    process.kill();
    said.wait_for_end(Duration::from_secs(1));
    complained.wait_for_end(Duration::from_secs(1));
    Ok(match complained.head() {
        complaint if complaint.is_empty() => said.head(),
        complaint => complaint,
    })
}
