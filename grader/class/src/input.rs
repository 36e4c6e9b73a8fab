//! The input, wherever it lies: a folder as it stands, an archive unpacked where it vanishes.

use std::fs;
use std::path::{Path, PathBuf};

use grader::build::room::{Room, clear_up};
use grader::submission::{NoSubmission, Submission};
use grader::tame::tame;

use crate::entry::{Entry, Source, several_archives};
use crate::layout::{self, Found, METADATA};
use crate::listing::{Node, list};
use crate::no_class::NoClass;
use crate::unpack::{CLASS, unpack};

/// The class as it was found, and where its files are for as long as this lives.
#[derive(Debug)]
pub struct Input {
    /// Who handed in what.
    pub found: Found,
    /// The folder of the class: where lists lie beside the submissions.
    pub root: Node,
    _unpacked: Option<Room>,
}

impl Input {
    /// Looks at the folder or archive at `path`. An archive is unpacked below `rooms`, for as long as
    /// this lives.
    pub fn open(path: &Path, rooms: &Path) -> Result<Self, NoClass> {
        clear_up(rooms);
        let at = |source| NoClass::Io {
            path: path.to_owned(),
            source,
        };
        let (unpacked, passed_over) = match fs::metadata(path) {
            Err(_) => return Err(NoClass::Nowhere(path.to_owned())),
            Ok(kind) if kind.is_dir() => (None, Vec::new()),
            Ok(_) => {
                let (room, passed_over) = unpack(path, rooms)?;
                (Some(room), passed_over)
            }
        };
        let folder = match &unpacked {
            Some(room) => room.path().join(CLASS),
            None => path.canonicalize().map_err(at)?,
        };
        let listed = list(&folder).map_err(at)?;
        let root = layout::unwrapped(&listed).clone();
        let metadata = root.find(METADATA).map(|node| fs::read(&node.path));
        let metadata = metadata.transpose().map_err(at)?;
        let metadata = metadata.map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        let mut found = layout::recognise(&root, metadata.as_deref())?;
        found.unmatched.extend(passed_over);
        match found.entries.is_empty() {
            true => Err(NoClass::Nobody(path.to_owned())),
            false => Ok(Input {
                found,
                root,
                _unpacked: unpacked,
            }),
        }
    }
}

/// The five files of an entry, or why there are none: which is its own matter.
pub fn collect(entry: &Entry) -> Result<Submission, String> {
    let mut submission = match &entry.source {
        Source::Path(path) => of_path(path)?,
        Source::Files(files) => {
            let submission = Submission::of_files(&entry.id, files);
            match submission.files.iter().any(|(_, text)| text.is_ok()) {
                true => submission,
                false => return Err(none_of_five(files)),
            }
        }
        Source::Nothing(why) => return Err(why.clone()),
    };
    submission.name.clone_from(&entry.id);
    Ok(submission)
}

fn of_path(path: &Path) -> Result<Submission, String> {
    match Submission::collect(path) {
        Err(NoSubmission::NoneOfFive(folder)) if folder.is_dir() => in_archive(&folder),
        other => other.map_err(|error| said(&error, path)),
    }
}

/// What platforms put into a folder of its own is often one archive.
fn in_archive(folder: &Path) -> Result<Submission, String> {
    let listed = list(folder).map_err(|error| error.to_string())?;
    let archives: Vec<&Node> = listed.nodes().iter().filter(|n| n.is_archive()).collect();
    match archives.as_slice() {
        [only] => Submission::collect(&only.path).map_err(|error| said(&error, folder)),
        [] if listed.nodes().is_empty() => Err("nothing was handed in: the folder is empty".into()),
        [] => Err("none of the five files was handed in".to_owned()),
        several => Err(several_archives(several.len())),
    }
}

/// Without the place, which is another one tomorrow.
fn said(error: &NoSubmission, place: &Path) -> String {
    let name = |path: &Path| {
        path.file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    };
    match error {
        NoSubmission::Nowhere(_) | NoSubmission::Neither(_) => {
            "it is not there any more".to_owned()
        }
        NoSubmission::NoneOfFive(_) => "none of the five files was handed in".to_owned(),
        NoSubmission::Several { folders, .. } => {
            let folders = tame(&folders.join(", "), 200);
            format!("several submissions in one, in {folders}: keep the one that counts")
        }
        NoSubmission::Refused { path, why } if path == place => why.to_string(),
        NoSubmission::Refused { path, why } => format!("{}: {why}", tame(&name(path), 200)),
    }
}

fn none_of_five(files: &[(String, PathBuf)]) -> String {
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let names = tame(&names.join(", "), 200);
    format!("none of the five files was handed in, but {names}")
}
