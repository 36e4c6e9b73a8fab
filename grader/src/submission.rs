//! Collecting a submission: five files from a folder, and nothing else.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::given::{GIVEN_FILES, MAIN, TASK_FILES, TaskFile};

/// The longest file that is read, in bytes; ours have about 10,000.
const LONGEST_FILE: u64 = 1 << 20;
/// The most other files that are named in a report.
const MOST_NAMED: usize = 20;

/// Five files as they were handed in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// The folder's name, for reports.
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
    /// It is not a folder.
    #[error("{0} is not a folder: unpack it, or name the folder that holds the five files")]
    NotAFolder(PathBuf),
    /// The folder holds none of the five.
    #[error(
        "{0} holds none of camera.rs, triangle.rs, sphere.rs, bbox.rs, bvh.rs, nor does its src/ or student/src/"
    )]
    NoneOfFive(PathBuf),
}

impl Submission {
    /// Reads the five files at the top of `folder`, else in its `src/`, else its `student/src/`.
    pub fn collect(folder: &Path) -> Result<Self, NoSubmission> {
        if !folder.exists() {
            return Err(NoSubmission::Nowhere(folder.to_owned()));
        }
        if !folder.is_dir() {
            return Err(NoSubmission::NotAFolder(folder.to_owned()));
        }
        let source = ["", "src", "student/src"]
            .map(|place| folder.join(place))
            .into_iter()
            .find(|place| {
                TASK_FILES
                    .iter()
                    .any(|file| place.join(file.name).symlink_metadata().is_ok())
            })
            .ok_or_else(|| NoSubmission::NoneOfFive(folder.to_owned()))?;

        let files = TASK_FILES.map(|file| (file, read(&source, file.name)));
        Ok(Submission {
            name: name(folder),
            files: files.to_vec(),
            notes: notes(&source),
        })
    }
}

/// What people call the folder; `student/.` and the like are resolved first.
fn name(folder: &Path) -> String {
    let resolved = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let name = resolved.file_name().unwrap_or(resolved.as_os_str());
    name.to_string_lossy().into_owned()
}

fn read(source: &Path, name: &'static str) -> Result<String, Unreadable> {
    let path = source.join(name);
    let io = |error: io::Error| Unreadable::Io {
        name,
        why: error.kind().to_string(),
    };
    // Looked at before it is opened: opening a pipe would wait for ever.
    match path.symlink_metadata() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(Unreadable::Missing(name));
        }
        Err(error) => return Err(io(error)),
        Ok(metadata) if !metadata.is_file() => return Err(Unreadable::NotAFile(name)),
        Ok(_) => {}
    }
    let mut bytes = Vec::new();
    let file = fs::File::open(&path).map_err(io)?;
    file.take(LONGEST_FILE + 1)
        .read_to_end(&mut bytes)
        .map_err(io)?;
    if bytes.len() as u64 > LONGEST_FILE {
        return Err(Unreadable::TooLong(name));
    }
    String::from_utf8(bytes).map_err(|error| Unreadable::NotText {
        name,
        byte: error.utf8_error().valid_up_to() + 1,
    })
}

/// What lies beside the five files. None of it is used, and nobody shall wonder why.
fn notes(source: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(source) else {
        return Vec::new();
    };
    let mut names: Vec<String> = entries
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".rs") && TASK_FILES.iter().all(|file| file.name != name))
        .collect();
    names.sort();

    let given = |name: &str| {
        let given = GIVEN_FILES.into_iter().chain([MAIN]);
        given.into_iter().find(|(given, _)| *given == name)
    };
    let note = |name: &String| match given(name) {
        // The reference's own main names another crate; it only draws pictures.
        Some((main, _)) if main == MAIN.0 => None,
        Some((_, text)) => {
            let theirs = fs::read_to_string(source.join(name)).unwrap_or_default();
            // Line ends are a matter between git, editors and systems.
            let same = theirs.lines().eq(text.lines());
            (!same).then(|| format!("{name} differs from the given one, which is used"))
        }
        None => Some(format!("{name} is not one of the five files: ignored")),
    };
    names.iter().filter_map(note).take(MOST_NAMED).collect()
}
