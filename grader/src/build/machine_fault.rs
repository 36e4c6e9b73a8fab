//! Failures of the machine during compilation, for which no submission may lose points.

use std::fs;
use std::path::{Path, PathBuf};

use crate::build::diagnostics::Diagnostic;
use crate::handed_out::TaskFile;
use crate::sandbox::ExitReason;
use crate::system;

/// Free disk space below which a failed compile is blamed on the disk, in bytes.
const MIN_FREE_BYTES: u64 = 64 << 20;
/// Part of the compiler's message if the linker was killed with SIGKILL. Resource limits end it
/// with other signals.
const LINKER_KILLED: &str = "signal: 9 (SIGKILL)";

/// Reasons why the machine cannot compile at the moment, regardless of the source code.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum MachineFault {
    /// The compiler was killed, most likely because the machine ran out of memory.
    #[error(
        "the system killed the compiler (signal 9), even for a small program: give this machine more memory, or grade fewer submissions at once"
    )]
    Memory,
    /// The disk is full.
    #[error("the disk is full: {} has {} MiB left, but a build needs up to {} MiB", .path.display(), .left >> 20, MIN_FREE_BYTES >> 20)]
    DiskFull {
        /// The folder that contains the build directory.
        path: PathBuf,
        /// Free space, in bytes.
        left: u64,
    },
}

impl MachineFault {
    /// Returns an error if the machine has failed. Errors that name a submission's file are never
    /// the machine's fault. `folder` is the build directory of the failed compile. It is removed
    /// before free space is checked, so that source code that fills the disk by itself is not
    /// excused.
    pub(super) fn check(
        exit_reason: ExitReason,
        errors: &[Diagnostic],
        task_files: &[TaskFile],
        folder: &Path,
    ) -> Result<(), Self> {
        if errors
            .iter()
            .any(|error| error.blamed_file(task_files).is_some())
        {
            return Ok(());
        }
        // Only the first line is checked, because the following lines may contain names chosen by
        // the submission.
        let first_line = |error: &Diagnostic| error.text().lines().next().map(str::to_owned);
        let linker = |error| first_line(error).is_some_and(|line| line.contains(LINKER_KILLED));
        if exit_reason.is_external_kill() || errors.iter().any(linker) {
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
    use crate::handed_out::RAYS;

    fn check(exit_reason: ExitReason, message: &str, span: &str) -> Result<(), MachineFault> {
        let line = format!(r#"{{"message":"{message}","level":"error","spans":[{span}]}}"#);
        let folder = TempDir::new().unwrap();
        let build_dir = folder.path().join("any");
        MachineFault::check(exit_reason, &errors(&line), RAYS.files, &build_dir)
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
