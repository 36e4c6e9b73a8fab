//! Tests whether a sandbox works on this machine. Instead of querying the system's features, it
//! attacks the sandbox from inside, with the same profiles that are used for submissions. A sandbox
//! that cannot be tested is considered unavailable.

use tempfile::TempDir;

use crate::build::Builder;
use crate::build::build_dir::BuildDir;
use crate::build::source_crate::{CompileOutcome, CrateKind};
use crate::build::trial;
use crate::machine::files;
use crate::machine::system;

/// Source of a program that attempts everything submissions must not do.
const ATTACK_PROGRAM: &str = include_str!("../../trial/attempts.rs");
/// The last line that the program prints.
const END: &str = "end";
/// Contents of a file that the sandbox must hide.
const SECRET: &str = "a secret that no submission may read";

/// The reason an isolation level isn't available.
#[derive(Debug, thiserror::Error)]
pub enum SelfTestError {
    /// A part of the sandbox cannot be set up, or a file for the test cannot be written.
    #[error("{0}")]
    Setup(String),
    /// The compiler fails in the sandbox.
    #[error("cannot compile and statically link a program in the sandbox: {0}")]
    NotCompiled(String),
    /// The compiler or a program can do something it must not do, or the test didn't finish.
    #[error("{0}")]
    Unsafe(String),
}

impl SelfTestError {
    fn setup(error: impl ToString) -> Self {
        SelfTestError::Setup(error.to_string())
    }
}

impl Builder {
    /// Tests the sandbox that submissions are compiled and run in.
    pub fn test_sandbox(&self) -> Result<(), SelfTestError> {
        let work = BuildDir::new_in(&self.folder).map_err(SelfTestError::setup)?;
        // Without a sandbox, any user of the machine could read the files in this folder.
        let public_folder = TempDir::new().map_err(SelfTestError::setup)?;
        let key = public_folder.path().join("key");
        system::make_folder_accessible(public_folder.path()).map_err(SelfTestError::setup)?;
        files::write(&key, SECRET).map_err(SelfTestError::setup)?;

        let compile = |name, text: &str, kind| {
            let compiled = self.rustc.compile_text(work.path(), name, text, kind);
            compiled.map_err(SelfTestError::setup)
        };
        let program = compile("attempts", ATTACK_PROGRAM, CrateKind::Program)?;
        let program = program.into_result().map_err(SelfTestError::NotCompiled)?;
        let reads = format!("pub const KEY: &str = include_str!({key:?});");
        match compile("reads", &reads, CrateKind::Library)? {
            CompileOutcome::Errors(errors) if !errors[0].text().contains(SECRET) => {}
            CompileOutcome::Done { .. } | CompileOutcome::Errors(_) | CompileOutcome::Failed(_) => {
                let why = "the compiler can read files that submissions must not see";
                return Err(SelfTestError::Unsafe(why.to_owned()));
            }
        }
        let input = format!("{}\n", key.display());
        let output = trial::run(&self.rustc.sandbox, &program, &input);
        let output = output.map_err(SelfTestError::setup)?;
        Err(SelfTestError::Unsafe(match output.lines().next() {
            Some(END) => return Ok(()),
            Some(what) if output.ends_with("end\n") => format!("a submission can {what}"),
            Some(_) | None => {
                format!("the program that tests the sandbox did not finish: {output}")
            }
        }))
    }
}
