//! What a machine can lack while it compiles: no submission shall pay for that.

use std::fs;
use std::path::{Path, PathBuf};

use crate::build::diagnostics::Diagnostic;
use crate::sandbox::ExitReason;
use crate::system;

/// The room on a disk that no honest compile fails with, in bytes.
const MIN_FREE_BYTES: u64 = 64 << 20;
/// What the compiler says of a linker that was ended by what its limits do not send.
const LINKER_KILLED: &str = "signal: 9 (SIGKILL)";

/// The machine can not compile now, whatever the text.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum MachineFault {
    /// Memory, by all that one can see.
    #[error(
        "the system has ended the compiler (signal 9): give this machine more memory, or grade fewer at once"
    )]
    Memory,
    /// Room on a disk.
    #[error("the disk is full: {} has {} MiB left, and a build takes up to {}", .path.display(), .left >> 20, MIN_FREE_BYTES >> 20)]
    DiskFull {
        /// The folder around the one that was compiled in.
        path: PathBuf,
        /// In bytes.
        left: u64,
    },
}

impl MachineFault {
    /// Whether it is the machine that has failed. Errors that name a submission's file are never its
    /// fault. `folder` is where it was compiled: what a failed compile has left there is removed, so
    /// that a text which fills the disk by itself is not excused.
    pub(super) fn check(
        ending: ExitReason,
        errors: &[Diagnostic],
        folder: &Path,
    ) -> Result<(), Self> {
        if errors.iter().any(|error| error.blamed_file().is_some()) {
            return Ok(());
        }
        // In its first line: below stand names that a submission may have chosen.
        let first_line = |error: &Diagnostic| error.text().lines().next().map(str::to_owned);
        let linker = |error| first_line(error).is_some_and(|line| line.contains(LINKER_KILLED));
        if ending.is_external_kill() || errors.iter().any(linker) {
            return Err(MachineFault::Memory);
        }
        fs::remove_dir_all(folder).ok();
        let path = folder.parent().unwrap_or(folder).to_owned();
        match system::free_space(&path) {
            Some(left) if left < MIN_FREE_BYTES => Err(MachineFault::DiskFull { path, left }),
            Some(_) | None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use tempfile::TempDir;

    use super::*;
    use crate::build::diagnostics::errors;

    fn check(ending: ExitReason, message: &str, span: &str) -> Result<(), MachineFault> {
        let line = format!(r#"{{"message":"{message}","level":"error","spans":[{span}]}}"#);
        let folder = TempDir::new().unwrap();
        MachineFault::check(ending, &errors(&line), &folder.path().join("any"))
    }

    #[test]
    fn sigkill_means_out_of_memory_and_limit_signals_do_not() {
        assert_eq!(
            check(ExitReason::Signal(9), "", ""),
            Err(MachineFault::Memory)
        );
        let linker = "linking with `cc` failed: signal: 9 (SIGKILL)";
        assert_eq!(
            check(ExitReason::Code(1), linker, ""),
            Err(MachineFault::Memory)
        );
        for limit in [6, 11, 24, 25] {
            assert_eq!(check(ExitReason::Signal(limit), "", ""), Ok(()));
        }
    }

    #[test]
    fn a_submission_cannot_fake_a_killed_linker() {
        let span = r#"{"file_name":"bvh.rs","is_primary":true}"#;
        assert_eq!(check(ExitReason::Code(1), LINKER_KILLED, span), Ok(()));
    }
}
