//! Collecting a submission: five files from a folder or an archive, and nothing else.
//!
//! An archive is read in memory and never unpacked: of all that it holds only these files are
//! looked at, by their exact names.

mod archive;
mod folder;
mod place;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::given::{GIVEN_FILES, MAIN, TASK_FILES, TaskFile};
use crate::tame::tame;

pub use archive::{Archive, Listing, Member, Refused};

/// The longest file that is read, in bytes; ours have about 10,000.
const LONGEST_FILE: u64 = 1 << 20;
/// The most other files that are named in a report.
const MOST_NAMED: usize = 20;
/// The most characters that are shown of a name.
const LONGEST_NAME: usize = 200;

/// Five files as they were handed in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// The folder's or archive's name, for reports.
    pub name: String,
    /// The text of each of the five files, in lecture order, or why there is none.
    pub files: Vec<(TaskFile, Result<String, Unreadable>)>,
    /// What lies beside them, and that it does not count.
    pub notes: Vec<String>,
}

/// Why one of the five files can not be graded. Its tasks earn nothing; the others are graded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unreadable {
    /// It is not there.
    #[error("{0} is missing")]
    Missing(&'static str),
    /// It is a folder, a link or a device.
    #[error("{0} is not a regular file")]
    NotAFile(&'static str),
    /// It is longer than any honest file.
    #[error("{0} is longer than 1 MiB")]
    TooLong(&'static str),
    /// It is not text.
    #[error("{name} is not UTF-8 text: byte {byte} belongs to no character")]
    NotText {
        /// The file.
        name: &'static str,
        /// The first byte that is wrong, counted from 1.
        byte: usize,
    },
    /// The system does not let us read it.
    #[error("{name} can not be read: {why}")]
    Io {
        /// The file.
        name: &'static str,
        /// The system's words.
        why: String,
    },
}

/// Why there is no submission at all: a matter for whoever typed the command.
#[derive(Debug, thiserror::Error)]
pub enum NoSubmission {
    /// There is nothing at this place.
    #[error("there is no {0}: name the folder with the five files, such as `student`")]
    Nowhere(PathBuf),
    /// It is a device, a pipe or a socket.
    #[error("{0} is neither a folder nor a file: name the folder that holds the five files")]
    Neither(PathBuf),
    /// It holds none of the five.
    #[error(
        "{0} holds none of camera.rs, triangle.rs, sphere.rs, bbox.rs, bvh.rs, nor does its src/ or student/src/"
    )]
    NoneOfFive(PathBuf),
    /// It holds them more than once.
    #[error("{path} holds several submissions, in {}: name one of them", folders.join(", "))]
    Several {
        /// Where.
        path: PathBuf,
        /// The folders that hold one each.
        folders: Vec<String>,
    },
    /// It is a file, and not an archive that can be graded.
    #[error("{path}: {why}")]
    Refused {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: Refused,
    },
}

impl Submission {
    /// Reads the five files at the top of a folder or archive, else in its `src/`, else its
    /// `student/src/`; else in the same places of the one folder in it that has any.
    pub fn collect(path: &Path) -> Result<Self, NoSubmission> {
        if path.is_dir() {
            return Ok(Submission::of(name(path), folder::read(path)?));
        }
        if path.is_file() {
            let contents = archive::read(path)?;
            return Ok(Submission::of(archive::name(&name(path)), contents));
        }
        Err(match path.symlink_metadata() {
            Ok(_) => NoSubmission::Neither(path.to_owned()),
            Err(_) => NoSubmission::Nowhere(path.to_owned()),
        })
    }

    /// Single files, each with the name that it was handed in by, wherever it lies now.
    pub fn of_files(name: &str, files: &[(String, PathBuf)]) -> Self {
        Submission::of(name.to_owned(), folder::read_files(files))
    }

    fn of(name: String, mut contents: Contents) -> Self {
        let mut text = |file: TaskFile| {
            let missing = || Err(Unreadable::Missing(file.name));
            let bytes = contents.five.remove(file.name).unwrap_or_else(missing)?;
            text_of(file.name, bytes)
        };
        Submission {
            name,
            files: TASK_FILES.map(|file| (file, text(file))).to_vec(),
            notes: notes(&contents.beside),
        }
    }
}

/// What was found where the five files lie.
#[derive(Debug, Default)]
struct Contents {
    /// Those of the five that are there.
    five: BTreeMap<&'static str, Result<Vec<u8>, Unreadable>>,
    /// Other Rust files, with their bytes where they are to be compared.
    beside: BTreeMap<String, Vec<u8>>,
}

/// The exact name of one of the five files. Anything else, however alike, is another file.
fn one_of_five(name: &str) -> Option<&'static str> {
    let mut files = TASK_FILES.into_iter();
    files.find(|file| file.name == name).map(|file| file.name)
}

/// Whether students were given a file of this name.
fn is_given(name: &str) -> bool {
    let mut given = GIVEN_FILES.iter().chain([&MAIN]);
    given.any(|(given, _)| *given == name)
}

/// A name as it can be shown: without anything that moves on a terminal.
fn shown(name: &str) -> String {
    tame(name, LONGEST_NAME).replace('\n', "\\n")
}

/// What people call the folder; `student/.` and the like are resolved first.
fn name(path: &Path) -> String {
    let resolved = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let name = resolved.file_name().unwrap_or(resolved.as_os_str());
    name.to_string_lossy().into_owned()
}

fn text_of(name: &'static str, bytes: Vec<u8>) -> Result<String, Unreadable> {
    if bytes.len() as u64 > LONGEST_FILE {
        return Err(Unreadable::TooLong(name));
    }
    String::from_utf8(bytes).map_err(|error| Unreadable::NotText {
        name,
        byte: error.utf8_error().valid_up_to() + 1,
    })
}

/// What lies beside the five files. None of it is used, and nobody shall wonder why.
fn notes(beside: &BTreeMap<String, Vec<u8>>) -> Vec<String> {
    let given = |name: &str| {
        let given = GIVEN_FILES.into_iter().chain([MAIN]);
        given.into_iter().find(|(given, _)| *given == name)
    };
    let note = |(name, bytes): (&String, &Vec<u8>)| match given(name) {
        // The reference's own main names another crate; it only draws pictures.
        Some((main, _)) if main == MAIN.0 => None,
        Some((_, text)) => {
            let theirs = String::from_utf8_lossy(bytes);
            // Line ends are a matter between git, editors and systems.
            let same = theirs.lines().eq(text.lines());
            (!same).then(|| format!("{name} differs from the given one, which is used"))
        }
        None => Some(format!(
            "{} is not one of the five files: ignored",
            shown(name)
        )),
    };
    beside.iter().filter_map(note).take(MOST_NAMED).collect()
}
