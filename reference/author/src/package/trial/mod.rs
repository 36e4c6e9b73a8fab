//! The trials of packages: each laid out and run as its platform does it.

pub mod classroom50;
pub mod github;
pub mod gradescope;
mod machine;
mod runner;
mod submission;
mod thief;

use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use grader::doctor::package::PackageError;
use zip::result::ZipError;

use crate::bundle::BundleError;
use crate::bundle::crates::CratesError;
use crate::bundle::secrets::SecretsError;
use crate::package::trial::machine::JobResult;

/// A package was not tried: our fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum TrialError {
    /// Cargo did not start us.
    #[error("cargo has to say where it is: run `cargo author package … --check`")]
    NoCargo,
    /// What a trial takes, where it has to be tried.
    #[error("{0}; where CI is set, a trial is not skipped")]
    Unsupported(String),
    /// The starter is not what it was.
    #[error("{file} has no line `{signature}` to be attacked at: adapt trial/thief.rs")]
    MissingAttackPoint {
        /// The file.
        file: &'static str,
        /// What it had.
        signature: String,
    },
    /// It can not be looked at.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// What students get can not be collected.
    #[error(transparent)]
    Bundle(#[from] BundleError),
    /// The crates are not at hand.
    #[error(transparent)]
    Crates(#[from] CratesError),
    /// What must not be told can not be read.
    #[error(transparent)]
    Secrets(#[from] SecretsError),
    /// It can not be unpacked.
    #[error("the zip: {0}")]
    Zip(#[from] ZipError),
    /// The system does not let us.
    #[error("can not use {}: {source}", path.display())]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

fn io_error(path: &Path) -> impl FnOnce(io::Error) -> TrialError {
    let path = path.to_owned();
    move |source| TrialError::Io { path, source }
}

/// Says on the terminal what a submission took, and complains if that is more than half of what the
/// platform gives: by CPU time at half of a core, which no other load of this machine changes.
fn check_time(whose: &str, ended: &JobResult, platform: Duration, complaints: &mut Vec<String>) {
    let Some(used) = ended.usage else {
        return println!("{:6.1} s  {whose}", ended.wall_time.as_secs_f64());
    };
    let slow = 2 * used.cpu;
    let memory = used.peak_memory.map_or(String::new(), |bytes| {
        format!(", {} MiB at most", bytes >> 20)
    });
    println!(
        "{:6.1} s of half a core ({:.1} s by the clock){memory}: {whose}",
        slow.as_secs_f64(),
        ended.wall_time.as_secs_f64()
    );
    if slow > platform / 2 {
        complaints.push(format!(
            "{whose} took {slow:.0?} of half a core, and the platform gives {platform:.0?}: half of it is the most"
        ));
    }
}
