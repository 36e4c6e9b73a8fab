//! Decides whether the machine is the reason that something fails: it is repeated while nothing else
//! of this process runs, and then compared with a program of the grader's own.

use std::io;
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// Held while a program runs: shared by those that run beside others.
static RUNNING: RwLock<()> = RwLock::new(());

/// The outcome of an attempt to compile or run something.
#[derive(Debug)]
pub enum Attempt<T> {
    /// The machine is not the reason for this outcome.
    Certain(T),
    /// The machine may be the reason for this outcome.
    Doubtful(T),
}

impl<T> Attempt<T> {
    /// Returns the outcome.
    pub fn into_outcome(self) -> T {
        match self {
            Attempt::Certain(outcome) | Attempt::Doubtful(outcome) => outcome,
        }
    }
}

/// Attempts something beside others and, if the outcome is doubtful, once more alone. If it is
/// doubtful again, `control` attempts the same with code of the grader's own, and returns an error
/// if that fails, too. Otherwise, the outcome stands. A thread must not call this within `attempt`
/// or `control`.
pub fn decide<T>(
    mut attempt: impl FnMut() -> io::Result<Attempt<T>>,
    control: impl FnOnce(&T) -> io::Result<()>,
) -> io::Result<T> {
    {
        let _permit = beside_others();
        if let Attempt::Certain(outcome) = attempt()? {
            return Ok(outcome);
        }
    }
    let _permit = alone();
    let outcome = match attempt()? {
        Attempt::Certain(outcome) => return Ok(outcome),
        Attempt::Doubtful(outcome) => outcome,
    };
    control(&outcome)?;
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
            Ok(if doubtful[attempts - 1] {
                Attempt::Doubtful(attempts)
            } else {
                Attempt::Certain(attempts)
            })
        };
        decide(attempt, |_| control)
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
