//! Temporary directories for building a submission, or for unpacking a class from an archive. Each
//! directory is newly created, so it contains nothing from an earlier build. It is removed after
//! use. If a grader is killed, the next grader removes the directory left behind.

use std::fs::{self, File, TryLockError};
use std::path::Path;

use tempfile::TempDir;

use crate::machine::files::{self, AtPath, PathError};

/// A file that is locked while the directory is in use. The system releases the lock when the
/// grader ends, even if it is killed.
const LOCK_FILE: &str = "lock";
/// Temporary name of the lock file until it is locked, so that no other grader can lock it first.
const UNLOCKED_FILE: &str = "lock.new";

/// A temporary directory, which is removed when this value is dropped.
#[derive(Debug)]
pub struct BuildDir {
    // Declared before the folder so that it is dropped first, since some systems cannot remove open
    // files.
    _lock: File,
    folder: TempDir,
}

impl BuildDir {
    /// Creates a directory inside `all`.
    pub fn new_in(all: &Path) -> Result<Self, PathError> {
        files::create_dir_all(all)?;
        let folder = TempDir::new_in(all).at("create a folder in", all)?;
        let unlocked = folder.path().join(UNLOCKED_FILE);
        let lock = File::create(&unlocked).at("create", &unlocked)?;
        lock.lock().at("lock", &unlocked)?;
        fs::rename(&unlocked, folder.path().join(LOCK_FILE)).at("rename", &unlocked)?;
        Ok(BuildDir {
            _lock: lock,
            folder,
        })
    }

    /// Returns the path of the directory.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// Removes the directories of graders that were killed.
pub fn remove_abandoned(all: &Path) {
    for entry in fs::read_dir(all).into_iter().flatten().flatten() {
        // A directory that cannot be opened, locked or removed may belong to someone else. Leaving
        // it there does no harm.
        let Ok(lock) = File::open(entry.path().join(LOCK_FILE)) else {
            continue;
        };
        match lock.try_lock() {
            Ok(()) => {
                drop(lock);
                fs::remove_dir_all(entry.path()).ok();
            }
            Err(TryLockError::WouldBlock | TryLockError::Error(_)) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn removes_only_unlocked_build_directories() {
        let all = TempDir::new().unwrap();
        let used = BuildDir::new_in(all.path()).unwrap();
        let left = all.path().join("left");
        fs::create_dir(&left).unwrap();
        File::create(left.join(LOCK_FILE)).unwrap();
        remove_abandoned(all.path());
        assert!(used.path().exists() && !left.exists());

        drop(used);
        assert_eq!(fs::read_dir(all.path()).unwrap().count(), 0);
    }
}
