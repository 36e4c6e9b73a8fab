//! The output folder. Each file appears in one step, and an entry's stamp last: whoever is killed
//! leaves whole entries and none that only looks like one.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grader::report::atomic_write;

use crate::entry::Entry;
use crate::outcome::{EntryOutcome, EntryResult, EntryState, ScoreSummary, Stamp};
use crate::run::Run;

const SCORE: &str = "score.json";
const REPORT: &str = "report.html";
const FEEDBACK: &str = "feedback.html";
const STAMP: &str = "entry.json";
const PREVIOUS: &str = "previous.json";
const RUN: &str = "run.json";
/// What the names of files begin with that are being written.
const TEMPORARY_PREFIX: &str = ".tmp";

/// A folder of results.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
}

/// The output folder can not be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The system does not let us.
    #[error("can not use {path}: {source}")]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
    /// A file of ours is not as we write it.
    #[error("{path} is not as it was written ({why}): take it away, and grade again")]
    Damaged {
        /// Which.
        path: PathBuf,
        /// What is wrong.
        why: String,
    },
}

impl Store {
    /// The results in this folder, or those that will be.
    pub fn new(folder: &Path) -> Self {
        Store {
            folder: folder.to_owned(),
        }
    }

    /// The folder itself.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Takes away what was being written when somebody was killed.
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

    /// Where one entry's files are.
    pub fn entry_folder(&self, id: &str) -> PathBuf {
        self.folder.join("students").join(id)
    }

    /// What is kept of the last run. None in a new folder.
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

    /// Keeps what the run is of.
    pub fn write_run(&self, run: &Run) -> Result<(), StoreError> {
        self.write(RUN, &json(run))
    }

    /// Writes a file of the class.
    pub fn write(&self, name: &str, text: &str) -> Result<(), StoreError> {
        let path = self.folder.join(name);
        atomic_write::write(text, &path).map_err(|source| io_error(&path, source))
    }

    /// The entry's row, if it was graded and its score follows from this key.
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

    /// Whether the same became of the entry before.
    pub fn has_state(&self, id: &str, state: &EntryState) -> bool {
        let stamp = self.read_stamp(id).ok().flatten();
        stamp.is_some_and(|stamp| stamp.state == *state)
    }

    /// Keeps what became of an entry whose score, if it has one, is written already.
    pub fn save_result(&self, row: &EntryResult, key: &str) -> Result<(), StoreError> {
        let folder = self.entry_folder(&row.id);
        let state = match &row.outcome {
            EntryOutcome::Graded(_) => EntryState::Graded,
            EntryOutcome::NothingToGrade(why) => EntryState::NothingToGrade(why.clone()),
            EntryOutcome::Fault(why) => EntryState::Fault(why.clone()),
        };
        if state != EntryState::Graded {
            // Whatever lies here is of another time, and nobody shall take it for this one's.
            for file in [SCORE, REPORT, FEEDBACK] {
                remove(&folder.join(file))?;
            }
        }
        let stamp = Stamp {
            key: key.to_owned(),
            info: row.info.clone(),
            state,
        };
        let path = folder.join(STAMP);
        atomic_write::write(&json(&stamp), &path).map_err(|source| io_error(&path, source))
    }

    /// Keeps what the entry's student may see.
    pub fn save_feedback(&self, id: &str, page: &str) -> Result<(), StoreError> {
        let path = self.entry_folder(id).join(FEEDBACK);
        atomic_write::write(page, &path).map_err(|source| io_error(&path, source))
    }

    /// Takes the stamp away, before anything under it changes.
    pub fn remove_stamp(&self, id: &str) -> Result<(), StoreError> {
        remove(&self.entry_folder(id).join(STAMP))
    }

    /// All rows that there are, in the order of their ids.
    pub fn results(&self) -> Result<Vec<EntryResult>, StoreError> {
        let mut rows = Vec::new();
        for id in self.ids()? {
            let Some(Stamp {
                info: about, state, ..
            }) = self.read_stamp(&id)?
            else {
                continue;
            };
            let outcome = match state {
                EntryState::Graded => EntryOutcome::Graded(Box::new(self.read_score(&id)?)),
                EntryState::NothingToGrade(why) => EntryOutcome::NothingToGrade(why),
                EntryState::Fault(why) => EntryOutcome::Fault(why),
            };
            rows.push(EntryResult {
                id,
                info: about,
                outcome,
            });
        }
        Ok(rows)
    }

    /// Keeps every score as the one before. Who has none has none before, either.
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

    /// The score before, if there is one.
    pub fn previous_score(&self, id: &str) -> Option<ScoreSummary> {
        let text = fs::read_to_string(self.entry_folder(id).join(PREVIOUS)).ok()?;
        ScoreSummary::parse(&text).ok()
    }

    /// The names of all entries, sorted.
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

/// Pretty, with a line end.
pub fn json(value: &impl serde::Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("it has no maps of odd keys");
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
