//! Reads the input, which is a folder or an archive. An archive is unpacked into a temporary
//! folder.

use std::fs;
use std::path::Path;

use grader::build::build_dir::{BuildDir, remove_abandoned};
use grader::files::{self, AtPath};
use grader::handed_out::HandedOut;
use grader::submission::{Submission, SubmissionError, listed, strip_archive_extension};
use judging::sanitize::{sanitize, sanitize_line};

use crate::entry::{Entry, Source};
use crate::error::Error;
use crate::file_tree::{Node, list_folder};
use crate::layout::{self, LayoutChoice, METADATA, RecognisedClass, UnmatchedPath};
use crate::outcome::EntryOutcome;
use crate::roster::Member;
use crate::unpack::{CLASS_FOLDER, unpack};

/// The maximum length, in characters, of a reason that lists names.
const MAX_CHARS: usize = 600;

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
    /// `parent`. Ambiguous names are checked against `known`, the people on the class's lists.
    pub fn open(
        choice: &LayoutChoice,
        path: &Path,
        parent: &Path,
        handed_out: &'static HandedOut,
        known: &[Member],
    ) -> Result<Self, Error> {
        remove_abandoned(parent);
        let refused = |why: &str| Err(Error::user(format!("{} {why}", path.display())));
        let unpacked = match fs::metadata(path) {
            Err(_) => {
                return refused(
                    "does not exist: pass the folder or archive that you downloaded from the platform",
                );
            }
            Ok(kind) if kind.is_dir() => None,
            Ok(_) => Some(unpack(path, parent, handed_out)?),
        };
        let folder = match &unpacked {
            Some(unpacked) => unpacked.build_dir.path().join(CLASS_FOLDER),
            None => path.canonicalize().at("read", path).map_err(Error::user)?,
        };
        let mut listed = list_folder(&folder).map_err(Error::user)?;
        let archive = path.file_name().map(|name| name.to_string_lossy());
        let archive = archive.as_deref().filter(|_| unpacked.is_some());
        if let Some(archive) = archive {
            // If the files at the top of the archive are the class, nothing else names the class.
            strip_archive_extension(archive).clone_into(&mut listed.name);
        }
        let (root, note) = match (choice.layout, listed.children()) {
            // If the only folder isn't named like a submission in the chosen layout, it contains
            // the class.
            (Some(layout), [only]) if layout.may_contain_class(only) => (only, None),
            _ => layout::find_class_folder(&listed, archive),
        };
        let root = root.clone();
        let metadata = root.find(METADATA).map(|node| files::read(&node.path));
        let metadata = metadata.transpose().map_err(Error::user)?;
        let metadata = metadata.map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        let mut class = layout::recognise(choice, &root, metadata.as_deref(), handed_out, known)?;
        // The note about a single folder is wrong if several submissions were found in it.
        let is_wrong = root.path == listed.path && class.entries.len() > 1;
        class.notes.extend(note.filter(|_| !is_wrong));
        let unpacked = unpacked.map(|unpacked| {
            class.unmatched.extend(unpacked.problems);
            reject_incomplete(&mut class, &folder, unpacked.incomplete);
            unpacked.build_dir
        });
        let hidden = layout::hidden_paths(&root.path).map_err(Error::user)?;
        class.unmatched.extend(hidden);
        let of_several = if class.entries.is_empty() {
            layout::side_by_side(&root, handed_out)
        } else {
            // If fewer than half of the entries seem to belong to several people, students may have
            // made mistakes, and the other entries can be graded.
            let is_many = 2 * class.mixtures.len() >= class.entries.len();
            class.mixtures.first().filter(|_| is_many).cloned()
        };
        if let Some(why) = of_several {
            let unpack = archive.map_or("", |_| "; unpack the archive first");
            let why = sanitize_line(&why, MAX_CHARS);
            return refused(&format!(
                "cannot be read as a class: {why}{unpack}. Alternatively, pass --layout tutorials \
                 if each folder contains several students' folders, --layout teams if the folders \
                 are from Microsoft Teams, or --layout folders if each folder is one submission"
            ));
        }
        if class.entries.is_empty() {
            return refused(
                "contains no submissions: pass the folder of a class; to grade a single submission, \
                 use `cargo grade`",
            );
        }
        Ok(Input {
            class,
            root,
            _unpacked: unpacked,
        })
    }
}

/// Handles the files that could not be unpacked. If such a file belongs to an entry, the entry is
/// marked as having no files. Otherwise, the file is added to the unmatched files.
fn reject_incomplete(class: &mut RecognisedClass, folder: &Path, incomplete: Vec<UnmatchedPath>) {
    for file in incomplete {
        let path = folder.join(&file.name);
        let mut entries = class.entries.iter_mut();
        let is_own = |entry: &&mut Entry| {
            let mut paths = entry.source.paths().into_iter();
            paths.any(|own| path.starts_with(own))
        };
        match entries.find(is_own) {
            Some(entry) => {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                let why = format!("{} cannot be unpacked: {}", sanitize(&name, 200), file.why);
                entry.leave_to_staff(why);
            }
            None => class.unmatched.push(file),
        }
    }
}

/// Reads an entry's task files. If there is nothing to grade or reading fails, returns the entry's
/// outcome instead. Other entries aren't affected.
pub fn collect_submission(
    entry: &Entry,
    handed_out: &'static HandedOut,
) -> Result<Submission, EntryOutcome> {
    let id = &entry.id;
    let (collected, input) = match &entry.source {
        Source::Path(path) => (Submission::collect(path, handed_out), path.as_path()),
        Source::Files(files) => (Submission::from_files(id, files, handed_out), Path::new(id)),
        Source::Missing(why) => return Err(EntryOutcome::NothingToGrade(why.clone())),
    };
    let mut submission = collected.map_err(|error| {
        let why = error_message(&error, input);
        if error.is_machine_fault() {
            EntryOutcome::fault(&why)
        } else {
            EntryOutcome::NothingToGrade(why)
        }
    })?;
    submission.name.clone_from(id);
    Ok(submission)
}

/// Returns the error's message without the path, which may be different in the next run.
fn error_message(error: &SubmissionError, input: &Path) -> String {
    match error {
        SubmissionError::NotFound { .. } | SubmissionError::NotFileOrFolder(_) => {
            "it no longer exists".to_owned()
        }
        SubmissionError::NoTaskFiles { found, advice, .. } => {
            let mut found = found.clone();
            found.retain(|name| !layout::is_written_into_folders(name));
            match sanitize(&listed(&found), 200) {
                _ if found.is_empty() => "nothing was handed in".to_owned(),
                found => format!("no task files were handed in, only {found}{advice}"),
            }
        }
        SubmissionError::Ambiguous { .. }
        | SubmissionError::StarterBesideCopies { .. }
        | SubmissionError::TooMany(_, _)
        | SubmissionError::Link { .. } => {
            let text = error.to_string();
            let rest = text.strip_prefix(&*input.to_string_lossy());
            let rest = rest.map(|rest| match rest.strip_prefix(": ") {
                Some(rest) => rest.to_owned(),
                None => format!("it{rest}"),
            });
            sanitize(&rest.unwrap_or(text), MAX_CHARS)
        }
        SubmissionError::Unreadable(error) if error.path == input => {
            format!("the folder or file cannot be read: {}", error.reason())
        }
        SubmissionError::Unreadable(error) => error.to_string(),
        SubmissionError::Machine(error) => error.to_string(),
        SubmissionError::Archive { path, why } if path == input => why.to_string(),
        SubmissionError::Archive { path, why } => {
            let path = path.strip_prefix(input).unwrap_or(path);
            format!("{}: {why}", sanitize(&path.to_string_lossy(), 200))
        }
    }
}
