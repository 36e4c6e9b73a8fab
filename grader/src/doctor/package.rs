//! Checks a package for Gradescope, classroom50 or GitHub as the platform will see it. Used by
//! `cargo author package --check`.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use judging::exam::Exam;
use rawzip::FileReader;

use crate::doctor::folder;
use crate::error::Error;
use crate::handed_out::HandedOut;
use crate::machine::files::AtPath;
use crate::machine::zipfile::{Zip, ZipError};
use crate::policy::Policy;

/// The scripts that Gradescope runs, at the root of the zip.
pub(super) const SCRIPTS: [&str; 2] = ["setup.sh", "run_autograder"];
/// The script that both of [`SCRIPTS`] call.
pub(super) const GRADE: &str = "pathtracing/grade";
pub(super) const EXAM: &str = "pathtracing/exam.json";
pub(super) const POLICY: &str = "pathtracing/policy.toml";
/// Maximum size of the inspected part of a file, in bytes.
const MAX_FILE_BYTES: u64 = 64 << 20;
/// Maximum number of entries in a zip. A package has several thousand.
const MAX_ENTRIES: usize = 100_000;

/// Returns a message for each problem, including what to do about it. If there are no messages, the
/// package will work.
pub fn problems(path: &Path, handed_out: &HandedOut) -> Result<Vec<String>, Error> {
    if path.is_dir() {
        Ok(folder::problems(path, handed_out))
    } else {
        Ok(read_package(path)?.problems(handed_out))
    }
}

/// The parts of a zip's contents that are checked.
#[derive(Debug, Default)]
pub(super) struct PackageContents {
    /// The permissions of every entry, keyed by the entry's name.
    pub(super) permissions: BTreeMap<String, u32>,
    /// The contents of the few files that are inspected, keyed by name.
    pub(super) inspected: BTreeMap<&'static str, Vec<u8>>,
    /// The entries that cannot be unpacked, each with the error.
    damaged: BTreeMap<String, String>,
}

/// Reads a zip and unpacks every entry in memory, to check that it can be unpacked.
pub(super) fn read_package(path: &Path) -> Result<PackageContents, Error> {
    let zip = |error: ZipError| {
        Error::User(format!(
            "{} is not a zip that can be unpacked ({error}): create it with `cargo author package \
             gradescope`",
            path.display()
        ))
    };
    let file = File::open(path).at("read", path)?;
    let length = file.metadata().at("read", path)?.len();
    let archive = Zip::open(FileReader::from(file), length, MAX_ENTRIES).map_err(zip)?;
    let mut contents = PackageContents::default();
    for entry in &archive.entries {
        let mut file = archive.read(entry).map_err(zip)?;
        let name = entry.name.clone();
        contents.permissions.insert(name.clone(), entry.permissions);
        let mut inspected = SCRIPTS.into_iter().chain([GRADE, EXAM, POLICY]);
        let mut bytes = Vec::new();
        let unpacked = match inspected.find(|inspected| *inspected == name) {
            Some(inspected) => {
                let read = Read::by_ref(&mut file)
                    .take(MAX_FILE_BYTES)
                    .read_to_end(&mut bytes);
                contents.inspected.insert(inspected, bytes);
                read.map(drop)
            }
            // Damage is only detected once the contents have been read to the end.
            None => io::copy(&mut file, &mut io::sink()).map(drop),
        };
        if let Err(error) = unpacked {
            contents.damaged.insert(name, error.to_string());
        }
    }
    Ok(contents)
}

impl PackageContents {
    /// Returns a message for each entry that cannot be unpacked.
    pub(super) fn damage_problems(&self) -> Vec<String> {
        let damaged = self
            .damaged
            .iter()
            .map(|(name, error)| format!("{name} is damaged ({error}): create the package again"));
        damaged.collect()
    }

    /// Returns whether this folder has any entries.
    pub(super) fn has_files_in(&self, folder: &str) -> bool {
        let mut names = self.permissions.keys();
        names.any(|name| name.starts_with(folder) && name != folder)
    }

    /// Returns a message for each of these folders that is empty.
    pub(super) fn empty_folder_problems(&self, folders: &[&str], platform: &str) -> Vec<String> {
        let empty = folders.iter().filter(|folder| !self.has_files_in(folder));
        let problems = empty.map(|folder| {
            format!("{folder} is empty: `cargo author package {platform}` creates its contents")
        });
        problems.collect()
    }
}

/// Returns the reason a policy doesn't fit the exam, or `None` if it fits.
pub(super) fn policy_problem(policy: &[u8], exam: &Exam) -> Option<String> {
    let path = Path::new(POLICY);
    let items = exam.items.iter().map(|item| item.id.as_str());
    let checked = Policy::for_exam(path, &String::from_utf8_lossy(policy), items);
    checked.err().map(|error| error.to_string())
}
