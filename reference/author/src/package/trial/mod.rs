//! Trials of packages: each package is set up and run as on its platform.

pub mod classroom50;
pub mod github;
pub mod gradescope;
mod machine;
mod runner;
mod submission;
mod thief;

use std::time::Duration;

use grader::doctor::package::PackageError;
use grader::files::PathError;
use zip::result::ZipError;

use crate::bundle::BundleError;
use crate::bundle::crates::CratesError;
use crate::bundle::secrets::SecretsError;
use crate::package::trial::machine::JobResult;

/// The reason why a trial cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum TrialError {
    /// The environment variable `CARGO` is not set.
    #[error("CARGO is not set: run `cargo author package … --check`")]
    NoCargo,
    /// The machine cannot run a trial, and `CI` is set.
    #[error("{0}; trials are not skipped while CI is set")]
    Unsupported(String),
    /// The starter no longer has a method that an attack is inserted into, or has it more than
    /// once.
    #[error("expected exactly one `{signature}` in {file}: adapt trial/thief.rs to the starter")]
    MissingAttackPoint {
        /// The name of the starter's file.
        file: &'static str,
        /// The expected first line of the method.
        signature: String,
    },
    /// The package cannot be read.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// The students' bundle cannot be collected.
    #[error(transparent)]
    Bundle(#[from] BundleError),
    /// The crates of the lock file cannot be read.
    #[error(transparent)]
    Crates(#[from] CratesError),
    /// The secrets cannot be read.
    #[error(transparent)]
    Secrets(#[from] SecretsError),
    /// The package cannot be unpacked.
    #[error("cannot unpack the package: {0}")]
    Zip(#[from] ZipError),
    /// A file operation failed.
    #[error(transparent)]
    File(#[from] PathError),
}

/// Prints the time that a submission took, and adds a problem if it is more than half of the
/// platform's limit. This time is estimated from the CPU time, assuming that the submission gets
/// half a core, so it does not depend on the load of this machine.
fn check_time(name: &str, job: &JobResult, limit: Duration, problems: &mut Vec<String>) {
    let Some(usage) = job.usage else {
        return println!("{:6.1} s  {name}", job.wall_time.as_secs_f64());
    };
    let time = 2 * usage.cpu;
    let memory = usage.peak_memory.map_or(String::new(), |bytes| {
        format!(", {} MiB peak memory", bytes >> 20)
    });
    println!(
        "{:6.1} s at half a core ({:.1} s wall time){memory}: {name}",
        time.as_secs_f64(),
        job.wall_time.as_secs_f64()
    );
    if time > limit / 2 {
        problems.push(format!(
            "{name} took {time:.0?} at half a core, which is more than half of the platform's \
             limit of {limit:.0?}"
        ));
    }
}
