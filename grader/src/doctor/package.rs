//! `cargo grade --doctor --package FILE`: a package as the platform will see it, before anybody
//! hands in.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use zip::ZipArchive;
use zip::result::ZipError;

use crate::exam_file::{self, ExamFile};
use crate::policy::Policy;

/// What Gradescope starts, at the root of the zip.
const SCRIPTS: [&str; 2] = ["setup.sh", "run_autograder"];
const EXAM: &str = "pathtracing/exam.json";
const POLICY: &str = "pathtracing/policy.toml";
/// The crates, so that nothing is fetched.
const CRATES: &str = "pathtracing/crates/registry/cache/";
/// What a folder for classroom50 may hold, in bytes.
const FOLDER_LIMIT: u64 = 10 << 20;
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
struct Contents {
    /// All names, with the mode that each is unpacked with, if it says so.
    modes: BTreeMap<String, Option<u32>>,
    /// The contents of the few files that are read.
    read: BTreeMap<&'static str, Vec<u8>>,
}

/// What is wrong, a sentence each with what to do. Empty if it will grade.
pub fn complaints(path: &Path) -> Result<Vec<String>, NoPackage> {
    match path.is_dir() {
        true => folder(path),
        false => Ok(contents(path)?.complaints()),
    }
}

fn contents(path: &Path) -> Result<Contents, NoPackage> {
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
        let wanted = SCRIPTS.into_iter().chain([EXAM, POLICY]);
        if let Some(wanted) = wanted.into_iter().find(|wanted| *wanted == name) {
            let mut bytes = Vec::new();
            let mut file = Read::by_ref(&mut file).take(LONGEST);
            file.read_to_end(&mut bytes).map_err(io)?;
            contents.read.insert(wanted, bytes);
        }
    }
    Ok(contents)
}

impl Contents {
    fn complaints(&self) -> Vec<String> {
        let mut complaints: Vec<String> =
            SCRIPTS.iter().flat_map(|name| self.script(name)).collect();
        // Of a zip that Gradescope can not even start, the rest says nothing.
        if complaints.is_empty() {
            complaints.extend(self.exam_and_policy());
            if !self.modes.keys().any(|name| name.starts_with(CRATES)) {
                complaints.push(format!(
                    "{CRATES} is empty: the grader could not be built without a network; write the package where `cargo build` has run"
                ));
            }
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
        let path = Path::new(POLICY);
        let policy = Policy::of_text(path, &String::from_utf8_lossy(policy));
        let checked = policy.and_then(|policy| policy.check(path, &exam));
        complaints.extend(checked.err().map(|error| error.to_string()));
        complaints
    }
}

/// A folder for classroom50.
fn folder(path: &Path) -> Result<Vec<String>, NoPackage> {
    let mut complaints = Vec::new();
    let mut size = 0;
    for name in ["autograder.py", "pathtracing.zip"] {
        match fs::metadata(path.join(name)) {
            Ok(metadata) => size += metadata.len(),
            Err(_) => complaints.push(format!(
                "there is no {name}: `cargo author package classroom50` writes both files of such a folder"
            )),
        }
    }
    if size > FOLDER_LIMIT {
        let size = size >> 20;
        complaints.push(format!("it holds {size} MiB, and classroom50 takes 10"));
    }
    Ok(complaints)
}
