//! `cargo grade --doctor --package FILE`: a package as the platform will see it, before anybody
//! hands in.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use zip::ZipArchive;
use zip::result::ZipError;

use crate::doctor::folder;
use crate::exam::Exam;
use crate::exam_file::{self, ExamFile};
use crate::policy::Policy;

/// What Gradescope starts, at the root of the zip.
const SCRIPTS: [&str; 2] = ["setup.sh", "run_autograder"];
/// What both of these call.
const GRADE: &str = "pathtracing/grade";
const EXAM: &str = "pathtracing/exam.json";
pub(super) const POLICY: &str = "pathtracing/policy.toml";
/// What the grader is built from, and the solution: folders that are not empty.
const PARTS: [&str; 4] = [
    "pathtracing/grader/src/",
    "pathtracing/student/framework/src/",
    "pathtracing/reference/src/",
    "pathtracing/reference/carried/",
];
/// The crates, so that nothing is fetched.
const CRATES: &str = "pathtracing/crates/registry/cache/";
/// What is told of them, without which cargo does not look for them.
const INDEX: &str = "pathtracing/crates/registry/index/";
/// One that only Linux needs, and that no other system has fetched.
const OF_LINUX: &str = "/landlock-";
/// The longest file that is looked into, in bytes.
const LONGEST: u64 = 64 << 20;

/// The package can not be looked at.
#[derive(Debug, thiserror::Error)]
pub enum NoPackage {
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
pub(super) struct Contents {
    /// All names, with the mode that each is unpacked with, if it says so.
    modes: BTreeMap<String, Option<u32>>,
    /// The contents of the few files that are looked into.
    read: BTreeMap<&'static str, Vec<u8>>,
    /// What can not be unpacked, and why.
    damaged: BTreeMap<String, String>,
}

/// What is wrong, a sentence each with what to do. Empty if it will grade.
pub fn complaints(path: &Path) -> Result<Vec<String>, NoPackage> {
    match path.is_dir() {
        true => Ok(folder::complaints(path)),
        false => Ok(contents(path)?.complaints()),
    }
}

/// All of a zip, unpacked to see that it can be.
pub(super) fn contents(path: &Path) -> Result<Contents, NoPackage> {
    let io = |source| NoPackage::Io {
        path: path.to_owned(),
        source,
    };
    let zip = |source| NoPackage::Zip {
        path: path.to_owned(),
        source,
    };
    let mut archive = ZipArchive::new(File::open(path).map_err(io)?).map_err(zip)?;
    let mut contents = Contents::default();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).map_err(zip)?;
        let name = file.name().map_err(zip)?.into_owned();
        contents.modes.insert(name.clone(), file.unix_mode());
        let mut wanted = SCRIPTS.into_iter().chain([GRADE, EXAM, POLICY]);
        let mut bytes = Vec::new();
        let unpacked = match wanted.find(|wanted| *wanted == name) {
            Some(wanted) => {
                let read = Read::by_ref(&mut file)
                    .take(LONGEST)
                    .read_to_end(&mut bytes);
                contents.read.insert(wanted, bytes);
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

impl Contents {
    fn complaints(&self) -> Vec<String> {
        let mut complaints = self.damages();
        complaints.extend(SCRIPTS.iter().flat_map(|name| self.script(name)));
        // Of a zip that Gradescope can not even start, the rest says nothing.
        if complaints.is_empty() {
            complaints.extend(self.script(GRADE));
            complaints.extend(self.exam_and_policy());
            complaints.extend(self.parts());
        }
        complaints
    }

    /// What the grader is built from.
    fn parts(&self) -> Vec<String> {
        let mut complaints = self.lacking(&PARTS, "gradescope");
        let is_for_linux = |name: &String| name.starts_with(CRATES) && name.contains(OF_LINUX);
        match [CRATES, INDEX].into_iter().find(|part| !self.has(part)) {
            Some(empty) => complaints.push(format!(
                "{empty} is empty: the grader could not be built without a network; write the package where `cargo build` has run"
            )),
            None if !self.modes.keys().any(is_for_linux) => complaints.push(format!(
                "{CRATES} lacks what only Linux needs, on which Gradescope runs: write the package on Linux"
            )),
            None => {}
        }
        complaints
    }

    fn script(&self, name: &'static str) -> Vec<String> {
        let Some(text) = self.read.get(name) else {
            let below = self
                .modes
                .keys()
                .find(|path| path.ends_with(&format!("/{name}")));
            return vec![match below {
                Some(path) => format!(
                    "{name} is at {path}: Gradescope looks at the root of the zip; zip what is in the folder, not the folder"
                ),
                None if name == GRADE => {
                    format!("there is no {name}: `cargo author package gradescope` writes it")
                }
                None => format!("there is no {name} at the root of the zip: Gradescope starts it"),
            }];
        };
        let is_executable = |mode: u32| mode & 0o111 != 0;
        let mode = self.modes.get(name).copied().flatten();
        let faults = [
            (
                !text.starts_with(b"#!"),
                "does not begin with #!, so nothing runs it",
            ),
            (
                text.contains(&b'\r'),
                "has the line ends of Windows, on which bash fails: pack it elsewhere, or with `cargo author package`",
            ),
            (
                mode.is_some_and(|mode| !is_executable(mode)),
                "is not executable: `chmod +x` it before it is packed",
            ),
        ];
        let faults = faults.into_iter().filter(|(is_there, _)| *is_there);
        faults.map(|(_, fault)| format!("{name} {fault}")).collect()
    }

    /// What can not be unpacked.
    pub(super) fn damages(&self) -> Vec<String> {
        let damaged = self.damaged.iter().map(|(name, error)| {
            format!("{name} is damaged ({error}): write the package once more")
        });
        damaged.collect()
    }

    /// The contents of one of the few files that are looked into.
    pub(super) fn text(&self, name: &str) -> Option<&[u8]> {
        self.read.get(name).map(Vec::as_slice)
    }

    /// Whether anything is in this folder.
    fn has(&self, folder: &str) -> bool {
        let mut names = self.modes.keys();
        names.any(|name| name.starts_with(folder) && name != folder)
    }

    /// Which of these folders are empty, and what writes them.
    pub(super) fn lacking(&self, folders: &[&str], platform: &str) -> Vec<String> {
        let empty = folders.iter().filter(|folder| !self.has(folder));
        let told = empty.map(|folder| {
            format!("{folder} is empty: `cargo author package {platform}` writes what is in it")
        });
        told.collect()
    }

    fn exam_and_policy(&self) -> Vec<String> {
        let (exam, policy) = match (self.read.get(EXAM), self.read.get(POLICY)) {
            (Some(exam), Some(policy)) => (exam, policy),
            (exam, _) => {
                let missing = if exam.is_none() { EXAM } else { POLICY };
                return vec![format!(
                    "there is no {missing}: `cargo author package gradescope` writes it"
                )];
            }
        };
        let exam = match exam_file::parse(Path::new(EXAM), exam) {
            Ok(ExamFile { exam, .. }) => exam,
            Err(error) => return vec![error.to_string()],
        };
        let mut complaints = Vec::new();
        if exam.id == "practice" {
            complaints.push(
                "it asks the practice exam, which students have with all its keys: name another with --exam-seed".to_owned(),
            );
        }
        complaints.extend(unfit(policy, &exam));
        complaints
    }
}

/// What is wrong with a policy for this exam.
pub(super) fn unfit(policy: &[u8], exam: &Exam) -> Option<String> {
    let path = Path::new(POLICY);
    let policy = Policy::of_text(path, &String::from_utf8_lossy(policy));
    let checked = policy.and_then(|policy| policy.check(path, exam));
    checked.err().map(|error| error.to_string())
}
