//! Resets tasks: replaces their methods, or entire files, with the starter's. The old files are
//! kept. Links are refused.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use judging::assignment::Task;

use crate::error::Error;
use crate::handed_out::HandedOut;
use crate::inputs::task_selection::TaskOrFile;
use crate::machine::backup;
use crate::machine::files::AtPath;
use crate::machine::system;
use crate::report::atomic_write;
use crate::workspace::{Workspace, display_path};

/// Resets the named tasks in a submission's folder, which is the student's own work by default.
/// Returns a message that says what has changed. If there is an error, nothing has changed, unless
/// the error occurred while writing.
pub fn reset(
    handed_out: &'static HandedOut,
    folder: Option<&Path>,
    names: &[TaskOrFile],
) -> Result<String, Error> {
    let workspace = Workspace::find()?;
    let folder = workspace.resolve(folder.unwrap_or(Path::new(handed_out.student)));
    let source = SourceFolder::find(&folder, handed_out)?;
    let changes: Vec<FileChange> = requests(handed_out, names)
        .into_iter()
        .map(|(file, request)| FileChange::new(handed_out, &source, file, request))
        .collect::<Result<_, Error>>()?;
    let lines: Vec<String> = changes
        .iter()
        .map(|change| change.apply(&source))
        .collect::<Result<_, Error>>()?;
    Ok(lines.concat())
}

/// The part of a file to reset.
enum Request {
    WholeFile,
    Methods(Vec<Task>),
}

/// Returns, for each file, the part to reset.
fn requests(handed_out: &HandedOut, names: &[TaskOrFile]) -> BTreeMap<&'static str, Request> {
    let mut requests: BTreeMap<&'static str, Request> = BTreeMap::new();
    for name in names {
        match *name {
            TaskOrFile::File(file) => {
                requests.insert(file, Request::WholeFile);
            }
            TaskOrFile::Task(task) => {
                let file = handed_out.assignment.info(task).file;
                let request = requests.entry(file);
                let request = request.or_insert_with(|| Request::Methods(Vec::new()));
                if let Request::Methods(tasks) = request {
                    tasks.push(task);
                }
            }
        }
    }
    requests
}

/// A file before and after the change.
struct FileChange {
    /// The file's name.
    file: &'static str,
    /// The file's current bytes, or `None` if it doesn't exist.
    before: Option<Vec<u8>>,
    /// The file's new text, or `None` if it wouldn't change.
    after: Option<String>,
    /// The name of the part that is reset, for use in a message.
    part: String,
}

impl FileChange {
    fn new(
        handed_out: &'static HandedOut,
        source: &SourceFolder,
        file: &'static str,
        request: Request,
    ) -> Result<Self, Error> {
        let before = source.read(file)?;
        let (part, after) = match request {
            Request::WholeFile => {
                let text = text_handed_out(handed_out, file);
                let is_changed = before.as_deref() != Some(text.as_bytes());
                let after = is_changed.then(|| text.to_owned());
                ("the whole file".to_owned(), after)
            }
            Request::Methods(tasks) => {
                let name = file;
                let bytes = before.as_deref().ok_or_else(|| {
                    Error::User(format!(
                        "{name} is missing: `cargo grade --reset {name}` restores the original file"
                    ))
                })?;
                let text = std::str::from_utf8(bytes);
                let text = text.map_err(|_| format!("{name} is not UTF-8 text: "));
                let fresh = text.and_then(|text| fresh_methods(handed_out, text, &tasks));
                fresh.map_err(|why| {
                    Error::User(format!(
                        "{why}`cargo grade --reset {name}` replaces the whole file and keeps a copy \
                         of the old one"
                    ))
                })?
            }
        };
        Ok(FileChange {
            file,
            before,
            after,
            part,
        })
    }

    /// Keeps the old file and writes the new one. Returns the lines of the message that are about
    /// this file.
    fn apply(&self, source: &SourceFolder) -> Result<String, Error> {
        let path = source.path.join(self.file);
        let part = &self.part;
        let Some(after) = &self.after else {
            return Ok(format!(
                "{}: nothing to reset, since {part} is unchanged\n",
                display_path(&path)
            ));
        };
        let kept = match &self.before {
            Some(bytes) => Some(backup::keep(&path, bytes)?),
            None => None,
        };
        atomic_write::write(after, &path)?;
        let kept = kept.map_or(String::new(), |kept| {
            format!("  your old file is kept as {}\n", display_path(&kept))
        });
        let others = source.others.iter().map(|other| other.join(self.file));
        let others = others.filter(|other| other.exists()).map(|other| {
            let other = display_path(&other);
            format!("  {other} is another copy of this file and wasn't changed\n")
        });
        let others: String = others.collect();
        Ok(format!(
            "{}: {part} reset to the version that was handed out\n{kept}{others}",
            display_path(&path)
        ))
    }
}

/// Returns the unmodified text of a task file or a given file.
fn text_handed_out(handed_out: &'static HandedOut, file: &str) -> &'static str {
    let task_file = handed_out.task_file(file).map(|file| file.starter);
    let given = || handed_out.given_file(file).map(|file| file.text);
    task_file
        .or_else(given)
        .expect("only files that were handed out can be named on the command line")
}

/// Returns the names of the tasks' methods, and the text with these methods replaced by the
/// starter's versions. The text is `None` if the methods are still the same as the starter's.
///
/// # Errors
///
/// Returns the beginning of a message, to which the caller adds a remedy.
fn fresh_methods(
    handed_out: &HandedOut,
    text: &str,
    tasks: &[Task],
) -> Result<(String, Option<String>), String> {
    let (mut methods, mut changed) = (Vec::new(), None);
    for task in tasks {
        let current = changed.as_deref().unwrap_or(text);
        let fresh = handed_out.task_methods(*task, current);
        let fresh = fresh.map_err(|why| format!("{why}; "))?;
        methods.push(fresh.names);
        if fresh.is_changed {
            changed = Some(fresh.fresh_text);
        }
    }
    Ok((methods.join(", "), changed))
}

/// A folder with task files.
struct SourceFolder {
    path: PathBuf,
    /// The submission's other folders with task files. Nothing is reset in them.
    others: Vec<PathBuf>,
}

impl SourceFolder {
    /// Finds the folder that contains a submission's task files, looking only in the places where
    /// the assignment expects them. If several folders contain task files, it is the one with the
    /// most.
    fn find(folder: &Path, handed_out: &HandedOut) -> Result<Self, Error> {
        refuse_link(folder)?;
        if !folder.is_dir() {
            return Err(Error::User(format!(
                "{} is not a folder: --reset only works on a folder, such as `student`; if this is an \
                 archive, unpack it first",
                folder.display()
            )));
        }
        let found = handed_out.folders_in(folder);
        let [below, others @ ..] = &found[..] else {
            return Err(Error::User(format!(
                "{} contains none of {}: pass the folder that contains the task files, such as `student`",
                folder.display(),
                handed_out.file_list()
            )));
        };
        let mut path = folder.to_owned();
        for part in below.split('/').filter(|part| !part.is_empty()) {
            path.push(part);
            refuse_link(&path)?;
        }
        let others = others
            .iter()
            .map(|below| folder.join(below).components().collect());
        Ok(SourceFolder {
            path,
            others: others.collect(),
        })
    }

    /// Returns the bytes of a file, or `None` if it doesn't exist.
    fn read(&self, file: &str) -> Result<Option<Vec<u8>>, Error> {
        let path = self.path.join(file);
        refuse_link(&path)?;
        if fs::symlink_metadata(&path).is_err() {
            return Ok(None);
        }
        let opened = system::open_regular_file(&path).at("read", &path)?;
        let mut opened = opened.ok_or_else(|| {
            let path = path.display();
            Error::User(format!(
                "{path} is not a regular file: move it away and try again"
            ))
        })?;
        let mut bytes = Vec::new();
        opened.read_to_end(&mut bytes).at("read", &path)?;
        Ok(Some(bytes))
    }
}

fn refuse_link(path: &Path) -> Result<(), Error> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_symlink() => Err(Error::User(format!(
            "{} is a link, and links are not followed: replace it with the actual file or folder",
            path.display()
        ))),
        Err(error) if error.kind() != io::ErrorKind::NotFound => Ok(Err(error).at("read", path)?),
        Ok(_) | Err(_) => Ok(()),
    }
}
