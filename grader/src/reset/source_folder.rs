//! The folder with the task files that are changed. Links are refused.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::handed_out::{HandedOut, TaskFile};
use crate::machine::files::AtPath;
use crate::machine::system;
use crate::submission::places;

/// A folder with task files.
pub(super) struct SourceFolder {
    pub(super) path: PathBuf,
}

impl SourceFolder {
    /// Finds the folder with the task files of a submission, where the assignment expects them.
    pub(super) fn find(folder: &Path, handed_out: &HandedOut) -> Result<Self, Error> {
        refuse_link(folder)?;
        if !folder.is_dir() {
            return Err(Error::User(format!(
                "{} is not a folder: --reset changes the files in a folder, such as `student`; unpack \
                 an archive first",
                folder.display()
            )));
        }
        let found: Vec<&str> = handed_out.folders_in(folder).collect();
        match found[..] {
            [] => Err(Error::User(format!(
                "{} has none of {}: name the folder with the task files, such as `student`",
                folder.display(),
                handed_out.file_list()
            ))),
            [below] => {
                let mut path = folder.to_owned();
                for part in below.split('/').filter(|part| !part.is_empty()) {
                    path.push(part);
                    refuse_link(&path)?;
                }
                Ok(SourceFolder { path })
            }
            _ => Err(Error::User(format!(
                "{} has task files in {}: name the one that you mean",
                folder.display(),
                places(&found)
            ))),
        }
    }

    /// Returns the bytes of a task file, or `None` if it does not exist.
    pub(super) fn read(&self, file: &TaskFile) -> Result<Option<Vec<u8>>, Error> {
        let path = self.path.join(file.name);
        refuse_link(&path)?;
        if fs::symlink_metadata(&path).is_err() {
            return Ok(None);
        }
        let opened = system::open_regular_file(&path).at("read", &path)?;
        let mut opened = opened.ok_or_else(|| {
            let path = path.display();
            Error::User(format!(
                "{path} is not a regular file: move it away, and try again"
            ))
        })?;
        let mut bytes = Vec::new();
        opened.read_to_end(&mut bytes).at("read", &path)?;
        Ok(Some(bytes))
    }
}

fn refuse_link(path: &Path) -> Result<(), Error> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_symlink() => Err(Error::User(format!(
            "{} is a link, and links are not followed: replace it with the actual file or folder",
            path.display()
        ))),
        Err(error) if error.kind() != io::ErrorKind::NotFound => Ok(Err(error).at("read", path)?),
        Ok(_) | Err(_) => Ok(()),
    }
}
