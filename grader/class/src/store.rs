//! Stores the results of a class in the output folder. Files are written atomically, and an entry's
//! stamp last, so a killed run never leaves an incomplete entry that looks complete.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grader::report::atomic_write;
use grader::report::html::with_counted;

use crate::entry::Entry;
use crate::outcome::{EntryOutcome, EntryResult, EntryState, ScoreSummary, Stamp};
use crate::run::Run;

const SCORE: &str = "score.json";
const REPORT: &str = "report.html";
const FEEDBACK: &str = "feedback.html";
const STAMP: &str = "entry.json";
const PREVIOUS: &str = "previous.json";
const RUN: &str = "run.json";
/// The prefix of temporary files, which are renamed once they are complete.
const TEMPORARY_PREFIX: &str = ".tmp";

/// An output folder.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
}

/// An error that prevents the output folder from being used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// A file or folder cannot be read or written.
    #[error("cannot use {path}: {source}")]
    Io {
        /// The path of the file or folder.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// A file has invalid contents.
    #[error("{path} is damaged ({why}): delete it and grade again")]
    Damaged {
        /// The path of the damaged file.
        path: PathBuf,
        /// The parser's message.
        why: String,
    },
}

impl Store {
    /// Returns the store in a folder, which need not exist yet.
    pub fn new(folder: &Path) -> Self {
        Store {
            folder: folder.to_owned(),
        }
    }

    /// Returns the path of the output folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Removes the temporary files of a killed run.
    pub fn remove_temporary_files(&self) -> Result<(), StoreError> {
        let entries = self.ids()?.into_iter().map(|id| self.entry_folder(&id));
        for folder in entries.chain([self.folder.clone()]) {
            let files = fs::read_dir(folder).into_iter().flatten().flatten();
            for file in files.filter(|file| is_temporary(&file.file_name())) {
                remove(&file.path())?;
            }
        }
        Ok(())
    }

    /// Returns the folder of an entry's files.
    pub fn entry_folder(&self, id: &str) -> PathBuf {
        self.folder.join("students").join(id)
    }

    /// Reads `run.json`; returns `None` in a new folder.
    pub fn read_run(&self) -> Result<Option<Run>, StoreError> {
        let path = self.folder.join(RUN);
        let text = match fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            read => read.map_err(|source| io_error(&path, source))?,
        };
        let run = serde_json::from_str(&text);
        run.map(Some).map_err(|error| StoreError::Damaged {
            path,
            why: error.to_string(),
        })
    }

    /// Writes `run.json`.
    pub fn write_run(&self, run: &Run) -> Result<(), StoreError> {
        self.write(RUN, &json(run))
    }

    /// Writes a file of the class, such as `class.json`, into the output folder.
    pub fn write(&self, name: &str, text: &str) -> Result<(), StoreError> {
        let path = self.folder.join(name);
        atomic_write::write(text, &path).map_err(|source| io_error(&path, source))
    }

    /// Returns the stored result of an entry if it was graded with this cache key.
    pub fn cached_result(&self, entry: &Entry, key: &str) -> Option<EntryResult> {
        let stamp = self.read_stamp(&entry.id).ok()??;
        let score = (stamp.key == key && stamp.state == EntryState::Graded)
            .then(|| self.read_score(&entry.id));
        Some(EntryResult {
            id: entry.id.clone(),
            info: entry.info.clone(),
            outcome: EntryOutcome::Graded(Box::new(score?.ok()?)),
        })
    }

    /// Returns whether the stored state of the entry equals `state`.
    pub fn has_state(&self, id: &str, state: &EntryState) -> bool {
        let stamp = self.read_stamp(id).ok().flatten();
        stamp.is_some_and(|stamp| stamp.state == *state)
    }

    /// Writes the stamp of an entry. If the entry has a score, it must already have been written.
    /// Otherwise, the entry's files from earlier runs are removed.
    pub fn save_result(&self, result: &EntryResult, key: &str) -> Result<(), StoreError> {
        let folder = self.entry_folder(&result.id);
        let state = match &result.outcome {
            EntryOutcome::Graded(_) => EntryState::Graded,
            EntryOutcome::NothingToGrade(why) => EntryState::NothingToGrade(why.clone()),
            EntryOutcome::Fault(why) => EntryState::Fault(why.clone()),
        };
        if state != EntryState::Graded {
            // The files of an earlier run must not be mistaken for those of this run.
            for file in [SCORE, REPORT, FEEDBACK] {
                remove(&folder.join(file))?;
            }
        }
        let stamp = Stamp {
            key: key.to_owned(),
            info: result.info.clone(),
            state,
        };
        let path = folder.join(STAMP);
        atomic_write::write(&json(&stamp), &path).map_err(|source| io_error(&path, source))
    }

    /// Writes the page that the student may see.
    pub fn save_feedback(&self, id: &str, page: &str) -> Result<(), StoreError> {
        let path = self.entry_folder(id).join(FEEDBACK);
        atomic_write::write(page, &path).map_err(|source| io_error(&path, source))
    }

    /// Puts a text about what the score counts towards the grade into the entry's pages.
    pub fn write_counted(&self, id: &str, text: Option<&str>) -> Result<(), StoreError> {
        for name in [REPORT, FEEDBACK] {
            let path = self.entry_folder(id).join(name);
            match fs::read_to_string(&path) {
                Ok(page) => {
                    let updated = with_counted(&page, text);
                    if updated != page {
                        let written = atomic_write::write(&updated, &path);
                        written.map_err(|source| io_error(&path, source))?;
                    }
                }
                // A shard's older results may lack a page.
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => return Err(io_error(&path, error)),
            }
        }
        Ok(())
    }

    /// Removes the stamp of an entry, before its other files change.
    pub fn remove_stamp(&self, id: &str) -> Result<(), StoreError> {
        remove(&self.entry_folder(id).join(STAMP))
    }

    /// Returns all results, in the order of their ids.
    pub fn results(&self) -> Result<Vec<EntryResult>, StoreError> {
        let mut results = Vec::new();
        for id in self.ids()? {
            let Some(Stamp { info, state, .. }) = self.read_stamp(&id)? else {
                continue;
            };
            let outcome = match state {
                EntryState::Graded => EntryOutcome::Graded(Box::new(self.read_score(&id)?)),
                EntryState::NothingToGrade(why) => EntryOutcome::NothingToGrade(why),
                EntryState::Fault(why) => EntryOutcome::Fault(why),
            };
            results.push(EntryResult { id, info, outcome });
        }
        Ok(results)
    }

    /// Saves the current score of every entry as its previous score. If an entry has no current
    /// score, its previous score is removed.
    pub fn save_previous_scores(&self) -> Result<(), StoreError> {
        for id in self.ids()? {
            let folder = self.entry_folder(&id);
            let path = folder.join(PREVIOUS);
            if self
                .read_stamp(&id)?
                .is_some_and(|s| s.state == EntryState::Graded)
            {
                let text = read(&folder.join(SCORE))?;
                atomic_write::write(&text, &path).map_err(|source| io_error(&path, source))?;
            } else {
                remove(&path)?;
            }
        }
        Ok(())
    }

    /// Returns the previous score of an entry, if there is one.
    pub fn previous_score(&self, id: &str) -> Option<ScoreSummary> {
        let text = fs::read_to_string(self.entry_folder(id).join(PREVIOUS)).ok()?;
        ScoreSummary::parse(&text).ok()
    }

    /// Returns the ids of all entries, sorted.
    pub fn ids(&self) -> Result<Vec<String>, StoreError> {
        let folder = self.folder.join("students");
        let entries = match fs::read_dir(&folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            entries => entries.map_err(|source| io_error(&folder, source))?,
        };
        let names = entries.flatten().map(|entry| entry.file_name());
        let mut ids: Vec<String> = names.filter_map(|name| name.into_string().ok()).collect();
        ids.sort();
        Ok(ids)
    }

    fn read_score(&self, id: &str) -> Result<ScoreSummary, StoreError> {
        let path = self.entry_folder(id).join(SCORE);
        let text = read(&path)?;
        ScoreSummary::parse(&text).map_err(|error| StoreError::Damaged {
            path,
            why: error.to_string(),
        })
    }

    fn read_stamp(&self, id: &str) -> Result<Option<Stamp>, StoreError> {
        let path = self.entry_folder(id).join(STAMP);
        match fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(source) => Err(io_error(&path, source)),
            Ok(text) => {
                serde_json::from_str(&text)
                    .map(Some)
                    .map_err(|error| StoreError::Damaged {
                        path,
                        why: error.to_string(),
                    })
            }
        }
    }
}

fn is_temporary(name: &OsStr) -> bool {
    name.to_string_lossy().starts_with(TEMPORARY_PREFIX)
}

/// Returns the value as indented JSON that ends in a newline.
pub fn json(value: &impl serde::Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("all map keys are strings");
    text.push('\n');
    text
}

fn read(path: &Path) -> Result<String, StoreError> {
    fs::read_to_string(path).map_err(|source| io_error(path, source))
}

fn remove(path: &Path) -> Result<(), StoreError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(io_error(path, error)),
        Ok(()) | Err(_) => Ok(()),
    }
}

fn io_error(path: &Path, source: io::Error) -> StoreError {
    StoreError::Io {
        path: path.to_owned(),
        source,
    }
}
