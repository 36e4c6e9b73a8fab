//! Reads the input, which is a folder or an archive. An archive is unpacked into a temporary
//! folder.

use std::fs;
use std::path::{Path, PathBuf};

use grader::build::build_dir::{BuildDir, remove_abandoned};
use grader::handed_out::HandedOut;
use grader::submission::{Submission, SubmissionError};
use judging::sanitize::sanitize;

use crate::entry::{Entry, Source, several_archives_message};
use crate::input_error::ClassInputError;
use crate::layout::{self, METADATA, RecognisedClass, UnmatchedPath};
use crate::listing::{Node, hidden_names, list_folder};
use crate::unpack::{CLASS_FOLDER, unpack};

/// The submissions of a class, before their files are read. If they were unpacked from an archive,
/// dropping this value deletes the unpacked files.
#[derive(Debug)]
pub struct Input {
    /// The class recognised in the input: its layout, its submissions and the unmatched files.
    pub class: RecognisedClass,
    /// The class's folder, which may contain lists as well as submissions.
    pub root: Node,
    _unpacked: Option<BuildDir>,
}

impl Input {
    /// Opens the folder or archive at `path`. An archive is unpacked into a temporary folder in
    /// `parent`.
    pub fn open(
        path: &Path,
        parent: &Path,
        handed_out: &'static HandedOut,
    ) -> Result<Self, ClassInputError> {
        remove_abandoned(parent);
        let at = |source| ClassInputError::Io {
            path: path.to_owned(),
            source,
        };
        let (unpacked, not_unpacked) = match fs::metadata(path) {
            Err(_) => return Err(ClassInputError::NotFound(path.to_owned())),
            Ok(kind) if kind.is_dir() => (None, Vec::new()),
            Ok(_) => {
                let (build_dir, not_unpacked) = unpack(path, parent)?;
                (Some(build_dir), not_unpacked)
            }
        };
        let folder = match &unpacked {
            Some(build_dir) => build_dir.path().join(CLASS_FOLDER),
            None => path.canonicalize().map_err(at)?,
        };
        let listed = list_folder(&folder).map_err(at)?;
        let root = layout::find_class_folder(&listed, handed_out).clone();
        let metadata = root.find(METADATA).map(|node| fs::read(&node.path));
        let metadata = metadata.transpose().map_err(at)?;
        let metadata = metadata.map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        let mut class = layout::recognise(&root, metadata.as_deref(), handed_out)?;
        class.unmatched.extend(not_unpacked);
        let hidden = hidden_names(&root.path).map_err(at)?;
        class
            .unmatched
            .extend(hidden.into_iter().map(|name| UnmatchedPath {
                name,
                why: "its name begins with a dot, so it is hidden".to_owned(),
            }));
        if class.entries.is_empty() {
            Err(ClassInputError::NoSubmissions(path.to_owned()))
        } else {
            Ok(Input {
                class,
                root,
                _unpacked: unpacked,
            })
        }
    }
}

/// Reads the task files of an entry. The error is the reason why this entry cannot be graded, and
/// does not affect others.
pub fn collect_submission(
    entry: &Entry,
    handed_out: &'static HandedOut,
) -> Result<Submission, String> {
    let mut submission = match &entry.source {
        Source::Path(path) => collect_path(path, handed_out)?,
        Source::Files(files) => {
            let submission = Submission::from_files(&entry.id, files, handed_out);
            if submission.files.iter().any(|(_, text)| text.is_ok()) {
                submission
            } else {
                return Err(no_task_file_message(files));
            }
        }
        Source::Missing(why) => return Err(why.clone()),
    };
    submission.name.clone_from(&entry.id);
    Ok(submission)
}

fn collect_path(path: &Path, handed_out: &'static HandedOut) -> Result<Submission, String> {
    match Submission::collect(path, handed_out) {
        Err(SubmissionError::NoTaskFiles { path: folder, .. }) if folder.is_dir() => {
            collect_single_archive(&folder, handed_out)
        }
        other => other.map_err(|error| error_message(&error, path)),
    }
}

/// Reads a folder that contains a single archive: platforms often create a folder for each
/// submission.
fn collect_single_archive(
    folder: &Path,
    handed_out: &'static HandedOut,
) -> Result<Submission, String> {
    let listed = list_folder(folder).map_err(|error| error.to_string())?;
    let archives: Vec<&Node> = listed
        .children()
        .iter()
        .filter(|n| n.is_archive())
        .collect();
    match archives.as_slice() {
        // The link could lead to another student's archive.
        [only] if only.is_link => Err(format!(
            "{} is a link, and links are not followed",
            sanitize(&only.name, 200)
        )),
        [only] => Submission::collect(&only.path, handed_out)
            .map_err(|error| error_message(&error, folder)),
        [] if listed.children().is_empty() => {
            Err("nothing was handed in: the folder is empty".into())
        }
        [] => Err("none of the task files was handed in".to_owned()),
        several => Err(several_archives_message(several.len())),
    }
}

/// Returns the error's message without the path, which may be different in the next run.
fn error_message(error: &SubmissionError, input: &Path) -> String {
    let name = |path: &Path| {
        path.file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    };
    match error {
        SubmissionError::NotFound(_) | SubmissionError::NotFileOrFolder(_) => {
            "it no longer exists".to_owned()
        }
        SubmissionError::NoTaskFiles { .. } => "none of the task files was handed in".to_owned(),
        SubmissionError::Ambiguous { folders, .. } => {
            let folders = sanitize(&folders.join(", "), 200);
            format!("it contains several submissions, in {folders}: keep the one that counts")
        }
        SubmissionError::Link { link, .. } => {
            format!("{link} is a link, and links are not followed")
        }
        SubmissionError::Io { why, .. } => format!("the folder or file cannot be read: {why}"),
        SubmissionError::Archive { path, why } if path == input => why.to_string(),
        SubmissionError::Archive { path, why } => format!("{}: {why}", sanitize(&name(path), 200)),
    }
}

fn no_task_file_message(files: &[(String, PathBuf)]) -> String {
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let names = sanitize(&names.join(", "), 200);
    format!("none of the task files was handed in, only {names}")
}
