//! What is in a package's zip.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use rawzip::FileReader;

use crate::exam::Exam;
use crate::policy::Policy;
use crate::zipfile::{Zip, ZipError};

/// What Gradescope starts, at the root of the zip.
pub(super) const SCRIPTS: [&str; 2] = ["setup.sh", "run_autograder"];
/// What both of these call.
pub(super) const GRADE: &str = "pathtracing/grade";
pub(super) const EXAM: &str = "pathtracing/exam.json";
pub(super) const POLICY: &str = "pathtracing/policy.toml";
/// The longest file that is looked into, in bytes.
const MAX_FILE_BYTES: u64 = 64 << 20;
/// The most files that are looked at: a package has some thousands.
const MAX_ENTRIES: usize = 100_000;

/// The package can not be looked at.
#[derive(Debug, thiserror::Error)]
pub enum PackageError {
    /// There is none, or it can not be read.
    #[error("can not read {}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// It is no zip.
    #[error(
        "{} is no zip that can be unpacked ({source}): write it with `cargo author package gradescope`",
        path.display()
    )]
    Zip {
        /// Which.
        path: PathBuf,
        /// What is wrong.
        source: ZipError,
    },
}

/// What of a zip is looked at.
#[derive(Debug, Default)]
pub(super) struct PackageContents {
    /// All names, with the permissions that each is unpacked with.
    pub(super) permissions: BTreeMap<String, u32>,
    /// The contents of the few files that are looked into.
    pub(super) inspected: BTreeMap<&'static str, Vec<u8>>,
    /// What can not be unpacked, and why.
    damaged: BTreeMap<String, String>,
}

/// All of a zip, unpacked to see that it can be.
pub(super) fn read_package(path: &Path) -> Result<PackageContents, PackageError> {
    let io = |source| PackageError::Io {
        path: path.to_owned(),
        source,
    };
    let zip = |source| PackageError::Zip {
        path: path.to_owned(),
        source,
    };
    let file = File::open(path).map_err(io)?;
    let length = file.metadata().map_err(io)?.len();
    let archive = Zip::open(FileReader::from(file), length, MAX_ENTRIES).map_err(zip)?;
    let mut contents = PackageContents::default();
    for entry in &archive.entries {
        let mut file = archive.read(entry).map_err(zip)?;
        let name = entry.name.clone();
        contents.permissions.insert(name.clone(), entry.permissions);
        let mut wanted = SCRIPTS.into_iter().chain([GRADE, EXAM, POLICY]);
        let mut bytes = Vec::new();
        let unpacked = match wanted.find(|wanted| *wanted == name) {
            Some(wanted) => {
                let read = Read::by_ref(&mut file)
                    .take(MAX_FILE_BYTES)
                    .read_to_end(&mut bytes);
                contents.inspected.insert(wanted, bytes);
                read.map(drop)
            }
            // Only to the end is it known whether it is whole.
            None => io::copy(&mut file, &mut io::sink()).map(drop),
        };
        if let Err(error) = unpacked {
            contents.damaged.insert(name, error.to_string());
        }
    }
    Ok(contents)
}

impl PackageContents {
    /// What can not be unpacked.
    pub(super) fn damage_problems(&self) -> Vec<String> {
        let damaged = self.damaged.iter().map(|(name, error)| {
            format!("{name} is damaged ({error}): write the package once more")
        });
        damaged.collect()
    }

    /// The contents of one of the few files that are looked into.
    pub(super) fn bytes_of(&self, name: &str) -> Option<&[u8]> {
        self.inspected.get(name).map(Vec::as_slice)
    }

    /// Whether anything is in this folder.
    pub(super) fn has_files_in(&self, folder: &str) -> bool {
        let mut names = self.permissions.keys();
        names.any(|name| name.starts_with(folder) && name != folder)
    }

    /// Which of these folders are empty, and what writes them.
    pub(super) fn empty_folder_problems(&self, folders: &[&str], platform: &str) -> Vec<String> {
        let empty = folders.iter().filter(|folder| !self.has_files_in(folder));
        let told = empty.map(|folder| {
            format!("{folder} is empty: `cargo author package {platform}` writes what is in it")
        });
        told.collect()
    }
}

/// What is wrong with a policy for this exam.
pub(super) fn policy_problem(policy: &[u8], exam: &Exam) -> Option<String> {
    let path = Path::new(POLICY);
    let policy = Policy::from_text(path, &String::from_utf8_lossy(policy));
    let checked = policy.and_then(|policy| policy.check(path, exam));
    checked.err().map(|error| error.to_string())
}
