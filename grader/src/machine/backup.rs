//! Copies of files that are about to be replaced.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::machine::files::{AtPath, PathError};

/// Writes a copy next to the file and returns the copy's path. The copy's name ends with the first
/// free number, e.g. `bvh.rs.bak-1`. Never replaces a file or follows a link.
pub(crate) fn keep(path: &Path, bytes: &[u8]) -> Result<PathBuf, PathError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut number = 1u32;
    loop {
        let copy = path.with_file_name(format!("{name}.bak-{number}"));
        // `create_new` fails if anything exists at the path, even if it was created just now.
        match OpenOptions::new().write(true).create_new(true).open(&copy) {
            Ok(mut file) => {
                let written = file.write_all(bytes).and_then(|()| file.sync_all());
                if written.is_err() {
                    // An incomplete copy would look like the student's work.
                    let _ = fs::remove_file(&copy);
                }
                return written.map(|()| copy.clone()).at("write", &copy);
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error).at("write", &copy),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_copy_gets_the_first_free_number() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("bvh.rs");
        fs::create_dir(folder.path().join("bvh.rs.bak-2")).unwrap();
        let name = |bytes: &[u8]| {
            let copy = keep(&file, bytes).unwrap();
            assert_eq!(fs::read(&copy).unwrap(), bytes);
            copy.file_name().unwrap().to_string_lossy().into_owned()
        };
        assert_eq!(name(b"one"), "bvh.rs.bak-1");
        assert_eq!(name(b"three"), "bvh.rs.bak-3");
        fs::remove_file(folder.path().join("bvh.rs.bak-1")).unwrap();
        assert_eq!(name(b"again"), "bvh.rs.bak-1");
    }
}
