//! The input, wherever it lies: a folder as it stands, an archive unpacked where it vanishes.

use std::fs;
use std::path::{Path, PathBuf};

use grader::build::build_dir::{BuildDir, remove_abandoned};
use grader::sanitize::sanitize;
use grader::submission::{Submission, SubmissionError};

use crate::entry::{Entry, Source, several_archives_message};
use crate::input_error::ClassInputError;
use crate::layout::{self, METADATA, RecognisedClass};
use crate::listing::{Node, list_folder};
use crate::unpack::{CLASS_FOLDER, unpack};

/// The class as it was found, and where its files are for as long as this lives.
#[derive(Debug)]
pub struct Input {
    /// Who handed in what.
    pub class: RecognisedClass,
    /// The folder of the class: where lists lie beside the submissions.
    pub root: Node,
    _unpacked: Option<BuildDir>,
}

impl Input {
    /// Looks at the folder or archive at `path`. An archive is unpacked below `rooms`, for as long as
    /// this lives.
    pub fn open(path: &Path, rooms: &Path) -> Result<Self, ClassInputError> {
        remove_abandoned(rooms);
        let at = |source| ClassInputError::Io {
            path: path.to_owned(),
            source,
        };
        let (unpacked, passed_over) = match fs::metadata(path) {
            Err(_) => return Err(ClassInputError::NotFound(path.to_owned())),
            Ok(kind) if kind.is_dir() => (None, Vec::new()),
            Ok(_) => {
                let (room, passed_over) = unpack(path, rooms)?;
                (Some(room), passed_over)
            }
        };
        let folder = match &unpacked {
            Some(room) => room.path().join(CLASS_FOLDER),
            None => path.canonicalize().map_err(at)?,
        };
        let listed = list_folder(&folder).map_err(at)?;
        let root = layout::find_class_folder(&listed).clone();
        let metadata = root.find(METADATA).map(|node| fs::read(&node.path));
        let metadata = metadata.transpose().map_err(at)?;
        let metadata = metadata.map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        let mut found = layout::recognise(&root, metadata.as_deref())?;
        found.unmatched.extend(passed_over);
        match found.entries.is_empty() {
            true => Err(ClassInputError::NoSubmissions(path.to_owned())),
            false => Ok(Input {
                class: found,
                root,
                _unpacked: unpacked,
            }),
        }
    }
}

/// The five files of an entry, or why there are none: which is its own matter.
pub fn collect_submission(entry: &Entry) -> Result<Submission, String> {
    let mut submission = match &entry.source {
        Source::Path(path) => collect_path(path)?,
        Source::Files(files) => {
            let submission = Submission::from_files(&entry.id, files);
            match submission.files.iter().any(|(_, text)| text.is_ok()) {
                true => submission,
                false => return Err(no_task_file_message(files)),
            }
        }
        Source::Missing(why) => return Err(why.clone()),
    };
    submission.name.clone_from(&entry.id);
    Ok(submission)
}

fn collect_path(path: &Path) -> Result<Submission, String> {
    match Submission::collect(path) {
        Err(SubmissionError::NoTaskFiles(folder)) if folder.is_dir() => {
            collect_single_archive(&folder)
        }
        other => other.map_err(|error| error_message(&error, path)),
    }
}

/// What platforms put into a folder of its own is often one archive.
fn collect_single_archive(folder: &Path) -> Result<Submission, String> {
    let listed = list_folder(folder).map_err(|error| error.to_string())?;
    let archives: Vec<&Node> = listed
        .children()
        .iter()
        .filter(|n| n.is_archive())
        .collect();
    match archives.as_slice() {
        [only] => Submission::collect(&only.path).map_err(|error| error_message(&error, folder)),
        [] if listed.children().is_empty() => {
            Err("nothing was handed in: the folder is empty".into())
        }
        [] => Err("none of the five files was handed in".to_owned()),
        several => Err(several_archives_message(several.len())),
    }
}

/// Without the place, which is another one tomorrow.
fn error_message(error: &SubmissionError, place: &Path) -> String {
    let name = |path: &Path| {
        path.file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    };
    match error {
        SubmissionError::NotFound(_) | SubmissionError::NotFileOrFolder(_) => {
            "it is not there any more".to_owned()
        }
        SubmissionError::NoTaskFiles(_) => "none of the five files was handed in".to_owned(),
        SubmissionError::Ambiguous { folders, .. } => {
            let folders = sanitize(&folders.join(", "), 200);
            format!("several submissions in one, in {folders}: keep the one that counts")
        }
        SubmissionError::Archive { path, why } if path == place => why.to_string(),
        SubmissionError::Archive { path, why } => format!("{}: {why}", sanitize(&name(path), 200)),
    }
}

fn no_task_file_message(files: &[(String, PathBuf)]) -> String {
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let names = sanitize(&names.join(", "), 200);
    format!("none of the five files was handed in, but {names}")
}
