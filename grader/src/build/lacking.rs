//! What a machine can lack while it compiles: no submission shall pay for that.

use std::fs;
use std::path::{Path, PathBuf};

use crate::build::diagnostics::Diagnostic;
use crate::sandbox::Ending;
use crate::system;

/// The room on a disk that no honest compile fails with, in bytes.
const ROOM: u64 = 64 << 20;
/// What the compiler says of a linker that was ended by what its limits do not send.
const LINKER_KILLED: &str = "signal: 9 (SIGKILL)";

/// The machine can not compile now, whatever the text.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum Lacking {
    /// Memory, by all that one can see.
    #[error(
        "the system has ended the compiler (signal 9): give this machine more memory, or grade fewer at once"
    )]
    Memory,
    /// Room on a disk.
    #[error("the disk is full: {} has {} MiB left, and a build takes up to {}", .path.display(), .left >> 20, ROOM >> 20)]
    Room {
        /// The folder around the one that was compiled in.
        path: PathBuf,
        /// In bytes.
        left: u64,
    },
}

impl Lacking {
    /// Whether it is the machine that has failed. Errors that name a submission's file are never its
    /// fault. `folder` is where it was compiled: what a failed compile has left there is removed, so
    /// that a text which fills the disk by itself is not excused.
    pub(super) fn check(ending: Ending, errors: &[Diagnostic], folder: &Path) -> Result<(), Self> {
        if errors.iter().any(|error| error.blamed().is_some()) {
            return Ok(());
        }
        // In its first line: below stand names that a submission may have chosen.
        let first_line = |error: &Diagnostic| error.text().lines().next().map(str::to_owned);
        let linker = |error| first_line(error).is_some_and(|line| line.contains(LINKER_KILLED));
        if ending.is_by_others() || errors.iter().any(linker) {
            return Err(Lacking::Memory);
        }
        fs::remove_dir_all(folder).ok();
        let path = folder.parent().unwrap_or(folder).to_owned();
        match system::free_space(&path) {
            Some(left) if left < ROOM => Err(Lacking::Room { path, left }),
            Some(_) | None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use tempfile::TempDir;

    use super::*;
    use crate::build::diagnostics::errors;

    fn check(ending: Ending, message: &str, span: &str) -> Result<(), Lacking> {
        let line = format!(r#"{{"message":"{message}","level":"error","spans":[{span}]}}"#);
        let folder = TempDir::new().unwrap();
        Lacking::check(ending, &errors(&line), &folder.path().join("any"))
    }

    #[test]
    fn who_was_killed_lacked_memory_and_who_reached_a_limit_did_not() {
        assert_eq!(check(Ending::Signal(9), "", ""), Err(Lacking::Memory));
        let linker = "linking with `cc` failed: signal: 9 (SIGKILL)";
        assert_eq!(check(Ending::Code(1), linker, ""), Err(Lacking::Memory));
        for limit in [6, 11, 24, 25] {
            assert_eq!(check(Ending::Signal(limit), "", ""), Ok(()));
        }
    }

    #[test]
    fn a_submission_can_not_say_that_its_linker_was_killed() {
        let span = r#"{"file_name":"bvh.rs","is_primary":true}"#;
        assert_eq!(check(Ending::Code(1), LINKER_KILLED, span), Ok(()));
    }
}
