//! Failures of the machine during compilation. No submission may lose points because of them.

use std::fs;
use std::io;
use std::path::Path;

use crate::build::diagnostics::Diagnostic;
use crate::machine::system;
use crate::sandbox::ExitReason;

/// Free disk space, in bytes, below which a failed compile is blamed on a full disk.
const MIN_FREE_BYTES: u64 = 64 << 20;
/// Part of the compiler's message if the linker was killed with SIGKILL. Resource limits kill it
/// with different signals.
const LINKER_KILLED: &str = "signal: 9 (SIGKILL)";

/// The message for a compiler that was killed, most likely because the machine ran out of memory.
pub(super) const KILLED: &str = "the system killed the compiler (signal 9), even for a small program: \
                                 give this machine more memory, or grade fewer submissions at a time";

/// Returns an error if the disk is full. `folder` is the build directory of a failed compile. This
/// directory is removed first, so that a submission that filled the disk itself isn't excused.
pub(super) fn check_disk(folder: &Path) -> io::Result<()> {
    fs::remove_dir_all(folder).ok();
    let path = folder.parent().unwrap_or(folder);
    match system::free_space(path) {
        Some(left) if left < MIN_FREE_BYTES => Err(io::Error::other(format!(
            "the disk is full: {} has {} MiB left, but a build needs up to {} MiB",
            path.display(),
            left >> 20,
            MIN_FREE_BYTES >> 20
        ))),
        Some(_) | None => Ok(()),
    }
}

/// Returns whether the system killed the compiler or the linker.
pub(super) fn is_killed(exit_reason: ExitReason, errors: &[Diagnostic]) -> bool {
    // Check only the first line, because the following lines may contain names chosen by the
    // submission.
    let first_line = |error: &Diagnostic| error.text().lines().next().map(str::to_owned);
    let linker = |error| first_line(error).is_some_and(|line| line.contains(LINKER_KILLED));
    exit_reason.is_external_kill() || errors.iter().any(linker)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::diagnostics::errors;

    #[test]
    fn sigkill_is_not_a_limit() {
        let is_killed = |exit_reason, message: &str| {
            let line = format!(r#"{{"message":"{message}","level":"error","spans":[]}}"#);
            is_killed(exit_reason, &errors(&line))
        };
        assert!(is_killed(ExitReason::Signal(9), ""));
        let linker = "linking with `cc` failed: signal: 9 (SIGKILL)";
        assert!(is_killed(ExitReason::Code(1), linker));
        for limit in [6, 11, 24, 25] {
            assert!(!is_killed(ExitReason::Signal(limit), ""));
        }
    }
}
