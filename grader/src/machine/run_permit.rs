//! Decides whether the machine is to blame for a failure. The failed operation is repeated while
//! this process runs nothing else, and then attempted with one of the grader's own programs for
//! comparison.

use std::io;
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// Held while a program runs. Programs that may run concurrently share it.
static RUNNING: RwLock<()> = RwLock::new(());

/// Attempts an operation while other programs may run. If the machine may be to blame for the
/// outcome, tries once more while nothing else runs. If the machine may still be to blame, calls
/// `control`, which attempts the same operation with the grader's own code and returns an error if
/// that fails too. Otherwise, the outcome stands. `attempt` and `control` must not call this
/// function.
pub fn decide<T>(
    mut attempt: impl FnMut() -> io::Result<T>,
    is_doubtful: impl Fn(&T) -> bool,
    control: impl FnOnce(&T) -> io::Result<()>,
) -> io::Result<T> {
    {
        let _permit = beside_others();
        let outcome = attempt()?;
        if !is_doubtful(&outcome) {
            return Ok(outcome);
        }
    }
    let _permit = alone();
    let outcome = attempt()?;
    if is_doubtful(&outcome) {
        control(&outcome)?;
    }
    Ok(outcome)
}

/// Returns a shared permit to compile or run something. Waits while an exclusive permit is held.
fn beside_others() -> RwLockReadGuard<'static, ()> {
    RUNNING.read().unwrap_or_else(PoisonError::into_inner)
}

/// Returns an exclusive permit to compile or run something. Waits until everything else has ended.
fn alone() -> RwLockWriteGuard<'static, ()> {
    RUNNING.write().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Calls `decide`. `doubtful` says for each attempt, in order, whether its outcome is doubtful.
    fn decided(doubtful: &[bool], control: io::Result<()>) -> io::Result<usize> {
        let mut attempts = 0;
        let attempt = || {
            attempts += 1;
            Ok(attempts)
        };
        decide(attempt, |attempt| doubtful[attempt - 1], |_| control)
    }

    #[test]
    fn a_doubtful_outcome_stands_if_it_is_repeated_and_the_control_succeeds() {
        let failed = || Err(io::Error::other("the control fails"));
        assert_eq!(decided(&[false], failed()).unwrap(), 1);
        assert_eq!(decided(&[true, false], failed()).unwrap(), 2);
        assert_eq!(decided(&[true, true], Ok(())).unwrap(), 2);
        assert!(decided(&[true, true], failed()).is_err());
    }
}
