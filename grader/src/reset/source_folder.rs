//! The folder with the task files that are changed. Links are refused.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::files::{AtPath, PathError};
use crate::handed_out::{HandedOut, TaskFile};
use crate::system;

use super::ResetError;

/// A folder with task files.
pub(super) struct SourceFolder {
    pub(super) path: PathBuf,
}

impl SourceFolder {
    /// Finds the folder with the task files of a submission, where the assignment expects them.
    pub(super) fn find(folder: &Path, handed_out: &HandedOut) -> Result<Self, ResetError> {
        refuse_link(folder)?;
        if !folder.is_dir() {
            return Err(ResetError::NotAFolder(folder.to_owned()));
        }
        let folders = handed_out.assignment.folders.iter();
        let found: Vec<&str> = folders
            .filter(|below| {
                let mut files = handed_out.file_names();
                files.any(|file| exists(&folder.join(below).join(file)))
            })
            .copied()
            .collect();
        match found[..] {
            [] => Err(ResetError::NoTaskFiles {
                folder: folder.to_owned(),
                files: handed_out.file_list(),
            }),
            [below] => {
                let mut path = folder.to_owned();
                for part in below.split('/').filter(|part| !part.is_empty()) {
                    path.push(part);
                    refuse_link(&path)?;
                }
                Ok(SourceFolder { path })
            }
            _ => Err(ResetError::SeveralFolders {
                folder: folder.to_owned(),
                folders: found.into_iter().map(str::to_owned).collect(),
            }),
        }
    }

    /// Returns the bytes of a task file, or `None` if it does not exist.
    pub(super) fn read(&self, file: &TaskFile) -> Result<Option<Vec<u8>>, ResetError> {
        let path = self.path.join(file.name);
        refuse_link(&path)?;
        if !exists(&path) {
            return Ok(None);
        }
        let opened = system::open_regular_file(&path).at("read", &path)?;
        let mut opened = opened.ok_or_else(|| ResetError::NotRegular(path.clone()))?;
        let mut bytes = Vec::new();
        opened.read_to_end(&mut bytes).at("read", &path)?;
        Ok(Some(bytes))
    }
}

/// Returns whether there is a file, a folder or a link at the path.
fn exists(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

fn refuse_link(path: &Path) -> Result<(), ResetError> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_symlink() => Err(ResetError::Link(path.to_owned())),
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            let failed: Result<(), PathError> = Err(error).at("read", path);
            Ok(failed?)
        }
        Ok(_) | Err(_) => Ok(()),
    }
}
