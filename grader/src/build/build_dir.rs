//! A folder for one submission's build, or for a class that was in an archive: fresh each time, so that
//! nothing of an earlier one can be taken for this one's, and gone afterwards. A grader that is killed
//! can not clear up; the next one does.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;

use tempfile::TempDir;

/// Locked as long as its folder is in use. The system lets go of it when a grader ends, however that
/// came.
const LOCK_FILE: &str = "lock";
/// What it is called until it is locked: nobody else shall be first.
const UNLOCKED_FILE: &str = "lock.new";

/// Such a folder. It vanishes with this.
#[derive(Debug)]
pub struct BuildDir {
    // Let go of before the folder is removed: some systems remove nothing that is open.
    _lock: File,
    folder: TempDir,
}

impl BuildDir {
    /// A new one in this folder.
    pub fn new_in(all: &Path) -> io::Result<Self> {
        fs::create_dir_all(all)?;
        let folder = TempDir::new_in(all)?;
        let lock = File::create(folder.path().join(UNLOCKED_FILE))?;
        lock.lock()?;
        fs::rename(
            folder.path().join(UNLOCKED_FILE),
            folder.path().join(LOCK_FILE),
        )?;
        Ok(BuildDir {
            _lock: lock,
            folder,
        })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// Removes the rooms of graders that were killed.
pub fn remove_abandoned(all: &Path) {
    for entry in fs::read_dir(all).into_iter().flatten().flatten() {
        // Whatever can not be opened, locked or removed is somebody's, and does no harm.
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
