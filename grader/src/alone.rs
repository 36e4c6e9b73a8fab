//! Lets one program run alone in this process, to find out whether others are the reason that it
//! fails.

use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// Held while a program runs: shared by those that run beside others.
static RUNNING: RwLock<()> = RwLock::new(());

/// Returns a permit to compile or run something beside others. Waits while something runs alone. A
/// thread must not hold two permits.
pub fn beside_others() -> RwLockReadGuard<'static, ()> {
    RUNNING.read().unwrap_or_else(PoisonError::into_inner)
}

/// Returns a permit to compile or run something alone. Waits until everything else has ended.
pub fn alone() -> RwLockWriteGuard<'static, ()> {
    RUNNING.write().unwrap_or_else(PoisonError::into_inner)
}
