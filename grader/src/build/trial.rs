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
use crate::build::room::Room;
use crate::build::rustc::{Compiled, Crate, Kind, Rustc};
use crate::capture::Capture;
use crate::sandbox::{Isolation, Profile};
use crate::system::{self, Limits};

/// Tries what no submission may do.
const ATTEMPTS: &str = include_str!("../../trial/attempts.rs");
/// Its last line.
const END: &str = "end";
/// Nothing that anybody could guess to have been in the file.
const PLANTED: &str = "planted, to be read by nobody";

const LIMITS: Limits = Limits {
    memory: 1 << 30,
    cpu: Duration::from_secs(10),
    file: 0,
};
/// A trial takes milliseconds, unless the machine is very busy.
const WALL: Duration = Duration::from_secs(30);

/// Why a level of isolation is not reached here.
#[derive(Debug, thiserror::Error)]
pub enum Shortfall {
    /// A part of it can not be put in place.
    #[error("{0}")]
    NotInPlace(io::Error),
    /// The compiler does not work in it.
    #[error("a program can not be compiled and linked statically in it: {0}")]
    NotCompiled(String),
    /// The compiler reads what it should not.
    #[error("a submission's compiler can read other files")]
    CompilerReads,
    /// A program does what it should not.
    #[error("a submission can {0}")]
    ProgramCan(String),
    /// The program that should have tried did not come to its end.
    #[error("a program that tried what is forbidden did not end well: {0}")]
    NotTried(String),
}

impl Builder {
    /// Tries out the sandbox that submissions are built and asked in.
    pub fn try_sandbox(&self) -> Result<(), Shortfall> {
        let work = Room::new_in(&self.folder).map_err(Shortfall::NotInPlace)?;
        // Where every user of the machine could read it, were it not for the sandbox.
        let place = TempDir::new().map_err(Shortfall::NotInPlace)?;
        let key = place.path().join("key");
        system::open_to_all(place.path()).map_err(Shortfall::NotInPlace)?;
        fs::write(&key, PLANTED).map_err(Shortfall::NotInPlace)?;

        let program = compile(
            &self.rustc,
            work.path(),
            "attempts",
            ATTEMPTS,
            Kind::Program,
        )?;
        let program = match program {
            Compiled::Done(program) => program,
            Compiled::Errors(errors) => {
                return Err(Shortfall::NotCompiled(errors[0].text().to_owned()));
            }
            Compiled::Failed(why) => return Err(Shortfall::NotCompiled(why)),
        };
        // At this level, nothing keeps the compiler from reading what its user may.
        if self.rustc.sandbox.level() > Isolation::SeccompOnly {
            let reads = format!("pub const KEY: &str = include_str!({key:?});");
            match compile(&self.rustc, work.path(), "reads", &reads, Kind::Library)? {
                Compiled::Errors(errors) if !errors[0].text().contains(PLANTED) => {}
                Compiled::Done(_) | Compiled::Errors(_) | Compiled::Failed(_) => {
                    return Err(Shortfall::CompilerReads);
                }
            }
        }
        let said = run(&self.rustc, &program, &key)?;
        match said.lines().next() {
            Some(END) => Ok(()),
            Some(what) if said.ends_with("end\n") => Err(Shortfall::ProgramCan(what.to_owned())),
            Some(_) | None => Err(Shortfall::NotTried(said)),
        }
    }
}

fn compile(
    rustc: &Rustc,
    work: &Path,
    name: &str,
    text: &str,
    kind: Kind,
) -> Result<Compiled, Shortfall> {
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
                behind: None,
            })
        });
    compiled.map_err(Shortfall::NotInPlace)
}

/// What the program says, on both streams.
fn run(rustc: &Rustc, program: &Path, key: &Path) -> Result<String, Shortfall> {
    let mut command = Command::new(program);
    system::clear_environment(&mut command);
    let folder = program.parent().unwrap_or(Path::new("."));
    let process = rustc.sandbox.start(command, folder, Profile::Probe, LIMITS);
    let mut process = process.map_err(Shortfall::NotInPlace)?;
    let stdout = process.child.stdout.take().expect("it is piped");
    let stderr = process.child.stderr.take().expect("it is piped");
    let (said, complained) = (
        Capture::start(stdout, 1 << 16),
        Capture::start(stderr, 1 << 16),
    );
    let mut stdin = process.child.stdin.take().expect("it is piped");
    // If it has ended already, its words say why.
    writeln!(stdin, "{}", key.display()).ok();

    let deadline = Instant::now() + WALL;
    while process.ending().is_none() && Instant::now() < deadline {
        thread::sleep(Duration::from_millis(1));
    }
    process.kill();
    said.settle(Duration::from_secs(1));
    complained.settle(Duration::from_secs(1));
    Ok(match complained.head() {
        complaint if complaint.is_empty() => said.head(),
        complaint => complaint,
    })
}
