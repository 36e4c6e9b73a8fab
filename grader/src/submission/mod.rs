//! Collecting a submission: five files from a folder or an archive, and nothing else.
//!
//! An archive is read in memory and never unpacked: of all that it holds only these files are
//! looked at, by their exact names.

mod archive;
mod folder;
mod source_folder;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::given_files::{GIVEN_FILES, MAIN_FILE, TASK_FILES, TaskFile};
use crate::sanitize::sanitize;

pub use archive::{Archive, ArchiveError, Listing, Member};

/// The longest file that is read, in bytes; ours have about 10,000.
const MAX_FILE_BYTES: u64 = 1 << 20;
/// The most other files that are named in a report.
const MAX_NOTES: usize = 20;
/// The most characters that are shown of a name.
const MAX_NAME_CHARS: usize = 200;

/// Five files as they were handed in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// The folder's or archive's name, for reports.
    pub name: String,
    /// The text of each of the five files, in lecture order, or why there is none.
    pub files: Vec<(TaskFile, Result<String, TaskFileError>)>,
    /// What lies beside them, and that it does not count.
    pub notes: Vec<String>,
}

/// Why one of the five files can not be graded. Its tasks earn nothing; the others are graded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TaskFileError {
    /// It is not there.
    #[error("{0} is missing")]
    Missing(&'static str),
    /// It is a folder, a link or a device.
    #[error("{0} is not a regular file")]
    NotRegular(&'static str),
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
pub enum SubmissionError {
    /// There is nothing at this place.
    #[error("there is no {0}: name the folder with the five files, such as `student`")]
    NotFound(PathBuf),
    /// It is a device, a pipe or a socket.
    #[error("{0} is neither a folder nor a file: name the folder that holds the five files")]
    NotFileOrFolder(PathBuf),
    /// It holds none of the five.
    #[error(
        "{0} holds none of camera.rs, triangle.rs, sphere.rs, bbox.rs, bvh.rs, nor does its src/ or student/src/"
    )]
    NoTaskFiles(PathBuf),
    /// It holds them more than once.
    #[error("{path} holds several submissions, in {}: name one of them", folders.join(", "))]
    Ambiguous {
        /// Where.
        path: PathBuf,
        /// The folders that hold one each.
        folders: Vec<String>,
    },
    /// It is a file, and not an archive that can be graded.
    #[error("{path}: {why}")]
    Archive {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: ArchiveError,
    },
}

impl Submission {
    /// Reads the five files at the top of a folder or archive, else in its `src/`, else its
    /// `student/src/`; else in the same places of the one folder in it that has any.
    pub fn collect(path: &Path) -> Result<Self, SubmissionError> {
        if path.is_dir() {
            return Ok(Submission::from_contents(
                folder_name(path),
                folder::read(path)?,
            ));
        }
        if path.is_file() {
            let contents = archive::read(path)?;
            return Ok(Submission::from_contents(
                archive::without_extension(&folder_name(path)),
                contents,
            ));
        }
        Err(match path.symlink_metadata() {
            Ok(_) => SubmissionError::NotFileOrFolder(path.to_owned()),
            Err(_) => SubmissionError::NotFound(path.to_owned()),
        })
    }

    /// Single files, each with the name that it was handed in by, wherever it lies now.
    pub fn from_files(name: &str, files: &[(String, PathBuf)]) -> Self {
        Submission::from_contents(name.to_owned(), folder::read_files(files))
    }

    fn from_contents(name: String, mut contents: SubmissionFiles) -> Self {
        let mut text = |file: TaskFile| {
            let missing = || Err(TaskFileError::Missing(file.name));
            let bytes = contents
                .task_files
                .remove(file.name)
                .unwrap_or_else(missing)?;
            decode(file.name, bytes)
        };
        Submission {
            name,
            files: TASK_FILES.map(|file| (file, text(file))).to_vec(),
            notes: notes(&contents.other_files),
        }
    }
}

/// What was found where the five files lie.
#[derive(Debug, Default)]
struct SubmissionFiles {
    /// Those of the five that are there.
    task_files: BTreeMap<&'static str, Result<Vec<u8>, TaskFileError>>,
    /// Other Rust files, with their bytes where they are to be compared.
    other_files: BTreeMap<String, Vec<u8>>,
}

/// The exact name of one of the five files. Anything else, however alike, is another file.
fn task_file_name(name: &str) -> Option<&'static str> {
    let mut files = TASK_FILES.into_iter();
    files.find(|file| file.name == name).map(|file| file.name)
}

/// Whether students were given a file of this name.
fn is_given_file(name: &str) -> bool {
    let mut given = GIVEN_FILES.iter().chain([&MAIN_FILE]);
    given.any(|(given, _)| *given == name)
}

/// A name as it can be shown: without anything that moves on a terminal.
fn display_name(name: &str) -> String {
    sanitize(name, MAX_NAME_CHARS).replace('\n', "\\n")
}

/// What people call the folder; `student/.` and the like are resolved first.
fn folder_name(path: &Path) -> String {
    let resolved = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let name = resolved.file_name().unwrap_or(resolved.as_os_str());
    name.to_string_lossy().into_owned()
}

fn decode(name: &'static str, bytes: Vec<u8>) -> Result<String, TaskFileError> {
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(TaskFileError::TooLong(name));
    }
    String::from_utf8(bytes).map_err(|error| TaskFileError::NotText {
        name,
        byte: error.utf8_error().valid_up_to() + 1,
    })
}

/// What lies beside the five files. None of it is used, and nobody shall wonder why.
fn notes(beside: &BTreeMap<String, Vec<u8>>) -> Vec<String> {
    let given = |name: &str| {
        let given = GIVEN_FILES.into_iter().chain([MAIN_FILE]);
        given.into_iter().find(|(given, _)| *given == name)
    };
    let note = |(name, bytes): (&String, &Vec<u8>)| match given(name) {
        // The reference's own main names another crate; it only draws pictures.
        Some((main, _)) if main == MAIN_FILE.0 => None,
        Some((_, text)) => {
            let theirs = String::from_utf8_lossy(bytes);
            // Line ends are a matter between git, editors and systems.
            let same = theirs.lines().eq(text.lines());
            (!same).then(|| format!("{name} differs from the given one, which is used"))
        }
        None => Some(format!(
            "{} is not one of the five files: ignored",
            display_name(name)
        )),
    };
    beside.iter().filter_map(note).take(MAX_NOTES).collect()
}
