//! Decides whether the machine is the reason that something fails: it is repeated while nothing else
//! of this process runs, and then compared with a program of the grader's own.

use std::io;
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// Held while a program runs: shared by those that run beside others.
static RUNNING: RwLock<()> = RwLock::new(());

/// Attempts something beside others and, if the machine may be the reason for the outcome, once more
/// alone. If it may be the reason again, `control` attempts the same with code of the grader's own, and
/// returns an error if that fails, too. Otherwise, the outcome stands. A thread must not call this
/// within `attempt` or `control`.
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

/// Returns a permit to compile or run something beside others. Waits while something runs alone.
fn beside_others() -> RwLockReadGuard<'static, ()> {
    RUNNING.read().unwrap_or_else(PoisonError::into_inner)
}

/// Returns a permit to compile or run something alone. Waits until everything else has ended.
fn alone() -> RwLockWriteGuard<'static, ()> {
    RUNNING.write().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decides about attempts that are doubtful or not, in this order.
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
