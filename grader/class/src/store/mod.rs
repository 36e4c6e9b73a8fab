//! Stores the results of a class in the output folder. Files are written atomically, and an entry's
//! stamp is written last, so a killed run never leaves an incomplete entry that looks complete.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::io::{Cursor, ErrorKind};
use std::path::{self, Path, PathBuf};

use grader::files::{self, PathError};
use grader::hand_in::archive_bytes;
use grader::report::atomic_write;
use grader::report::html::{with_name, without_file_notes, write_counted};
use grader::rerun_command::with_moved_submission;
use grader::submission::Submission;
use serde::de::DeserializeOwned;
use serde_json::Value;
use zip::ZipArchive;

use crate::error::Error;
use crate::outcome::{EntryOutcome, EntryResult, ScoreSummary, Stamp};
use crate::run::Run;

const SCORE: &str = "score.json";
const REPORT: &str = "report.html";
/// The page that the student may see.
pub const FEEDBACK: &str = "feedback.html";
/// The archive with the graded task files. The report's commands refer to it.
pub const SUBMISSION: &str = "submission.zip";
const STAMP: &str = "entry.json";
/// The file with an entry's score from before the current round.
pub const PREVIOUS: &str = "previous.json";
/// The file with the score that an older version of the entry's submission got.
pub const REPLACED: &str = "replaced.json";
const RUN: &str = "run.json";
/// The prefix of temporary files, which are renamed when complete.
const TEMPORARY_PREFIX: &str = ".tmp";

/// An output folder.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
}

/// Returns the error to report when the contents of a file are invalid.
fn damaged(path: &Path, why: &serde_json::Error) -> Error {
    let path = path.display();
    Error::machine(format!(
        "{path} is damaged ({why}): delete it and grade again"
    ))
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
    pub fn remove_temporary_files(&self) -> Result<(), Error> {
        let entries = self.ids()?.into_iter().map(|id| self.entry_folder(&id));
        for folder in entries.chain([self.folder.clone()]) {
            let mut files = list_if_exists(&folder)?;
            files.retain(|file| is_temporary(file.file_name().unwrap_or_default()));
            files.into_iter().try_for_each(files::remove_if_exists)?;
        }
        Ok(())
    }

    /// Returns the folder with an entry's files.
    pub fn entry_folder(&self, id: &str) -> PathBuf {
        self.folder.join("students").join(id)
    }

    /// Returns the absolute path of the archive with an entry's graded files. The entry's report
    /// refers to it.
    pub fn submission_path(&self, id: &str) -> PathBuf {
        let path = self.entry_folder(id).join(SUBMISSION);
        path::absolute(&path).unwrap_or(path)
    }

    /// Reads `run.json`. Returns `None` in a new folder.
    pub fn read_run(&self) -> Result<Option<Run>, Error> {
        self.read(RUN)
    }

    /// Writes `run.json`.
    pub fn write_run(&self, run: &Run) -> Result<(), Error> {
        self.write(RUN, json(run))
    }

    /// Reads one of the class's JSON files. Returns `None` if it doesn't exist.
    pub fn read<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>, Error> {
        read_json(self.folder.join(name))
    }

    /// Returns the paths of the files in a subfolder of the output folder.
    pub fn list(&self, name: &str) -> Result<Vec<PathBuf>, Error> {
        Ok(list_if_exists(&self.folder.join(name))?)
    }

    /// Removes the files with this suffix, and temporary files, from a subfolder of the output
    /// folder.
    pub fn clear(&self, name: &str, suffix: &str) -> Result<(), Error> {
        for path in self.list(name)? {
            let name = path.file_name().unwrap_or_default();
            if name.to_string_lossy().ends_with(suffix) || is_temporary(name) {
                files::remove_if_exists(&path)?;
            }
        }
        Ok(())
    }

    /// Writes one of the class's files, such as `class.json`, into the output folder.
    pub fn write(&self, name: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> Result<(), Error> {
        Ok(atomic_write::write(contents, &self.folder.join(name))?)
    }

    /// Writes one of an entry's files, such as [`FEEDBACK`].
    pub fn write_of_entry(
        &self,
        id: &str,
        name: impl AsRef<Path>,
        contents: impl AsRef<[u8]>,
    ) -> Result<(), Error> {
        let path = self.entry_folder(id).join(name);
        Ok(atomic_write::write(contents, &path)?)
    }

    /// Removes one of the class's files from the output folder, if it exists.
    pub fn remove(&self, name: &str) -> Result<(), Error> {
        Ok(files::remove_if_exists(self.folder.join(name))?)
    }

    /// Returns the score of an entry if it was graded with this cache key.
    pub fn cached_score(&self, id: &str, key: &str) -> Option<ScoreSummary> {
        let stamp = self.read_stamp(id).ok()??;
        (stamp.key == key).then(|| self.read_score(id))?.ok()
    }

    /// Returns true if there is nothing to grade according to this outcome and the outcome is the
    /// one stored for the entry.
    pub fn has_nothing_to_grade(&self, id: &str, outcome: &EntryOutcome) -> bool {
        let stamp = self.read_stamp(id).ok().flatten();
        matches!(outcome, EntryOutcome::NothingToGrade(_))
            && stamp.is_some_and(|stamp| stamp.result.outcome == *outcome)
    }

    /// Writes an entry's stamp. If the entry has a score, the score must already have been written.
    /// If it has none, its files from earlier runs are removed. `round` is the round of the current
    /// run.
    pub fn save_result(&self, result: &EntryResult, key: &str, round: u32) -> Result<(), Error> {
        let folder = self.entry_folder(&result.id);
        if result.score().is_none() {
            // The files of an earlier run must not be mistaken for this run's. Remove its stamp
            // first, because a stamp must not be left without a score.
            for file in [STAMP, SCORE, REPORT, FEEDBACK, SUBMISSION] {
                files::remove_if_exists(folder.join(file))?;
            }
        }
        let stamp = Stamp {
            key: key.to_owned(),
            round,
            result: result.clone(),
        };
        self.write_of_entry(&result.id, STAMP, json(&stamp))
    }

    /// Reads one of an entry's files as text.
    pub fn read_of_entry(&self, id: &str, name: &str) -> Result<String, Error> {
        Ok(files::read_to_string(self.entry_folder(id).join(name))?)
    }

    /// Adds sentences to the entry's pages, first for staff and then for students. They explain how
    /// the score contributes to the grade. `failing` contains the items that cost final points, one of
    /// which is the pages' next step.
    pub fn write_counted(
        &self,
        id: &str,
        texts: &[Vec<String>; 2],
        failing: &BTreeSet<String>,
    ) -> Result<(), Error> {
        for (page, texts) in [REPORT, FEEDBACK].into_iter().zip(texts) {
            // Older results from a shard may lack a page.
            write_counted(&self.entry_folder(id).join(page), texts, failing)?;
        }
        Ok(())
    }

    /// Saves the score of an entry whose submission has changed, before the entry is graded again.
    /// In a new round, unchanged files are graded again too. Their earlier scores are only kept by
    /// [`save_previous_scores`](Self::save_previous_scores). `submission` is `None` if there is
    /// nothing to grade.
    pub fn set_score_aside(
        &self,
        id: &str,
        round: u32,
        submission: Option<&Submission>,
    ) -> Result<(), Error> {
        let stamp = self.read_stamp(id)?;
        let last = files::read(self.entry_folder(id).join(SUBMISSION)).ok();
        let is_other = |last: Vec<u8>| {
            submission.is_some_and(|own| checksums(&packed(own)) != checksums(&last))
        };
        let is_changed = last.is_some_and(is_other);
        let is_kept =
            |stamp: Stamp| stamp.result.score().is_some() && (stamp.round == round || is_changed);
        if stamp.is_some_and(is_kept) {
            self.write_of_entry(id, REPLACED, self.read_of_entry(id, SCORE)?)?;
        }
        Ok(())
    }

    /// Removes an entry's stamp before its other files change.
    pub fn remove_stamp(&self, id: &str) -> Result<(), Error> {
        Ok(files::remove_if_exists(self.entry_folder(id).join(STAMP))?)
    }

    /// Replaces an entry's files with the same entry's files from another store. As in grading, the
    /// stamp is removed first and written last, so that a killed merge never leaves a stamp next to
    /// another run's score.
    pub fn copy_entry(&self, id: &str, from: &Store) -> Result<(), Error> {
        self.copy_files(id, from, id)?;
        match files::read_if_exists(from.entry_folder(id).join(STAMP))? {
            Some(stamp) => self.write_of_entry(id, STAMP, stamp),
            None => Ok(()),
        }
    }

    /// Replaces an entry's files, apart from the stamp, with those of the entry `old_id` in another
    /// store. If the two ids differ, the new id replaces the old one in pages and scores. The scores
    /// of earlier runs and notes with the names of other files are left out.
    pub fn copy_files(&self, id: &str, from: &Store, old_id: &str) -> Result<(), Error> {
        let folder = self.entry_folder(id);
        files::create_dir_all(&folder)?;
        self.remove_stamp(id)?;
        // A file from an earlier merge must not be mistaken for one from this merge.
        for file in files::read_dir(&folder)? {
            files::remove_if_exists(file)?;
        }
        let [was, now] = [from.submission_path(old_id), self.submission_path(id)];
        let is_other = id != old_id;
        let is_kept = |name: &OsStr| !is_other || (name != PREVIOUS && name != REPLACED);
        for source in files::read_dir(from.entry_folder(old_id))? {
            let name = source.file_name().unwrap_or_default();
            let contents = if name == REPORT || name == FEEDBACK {
                let page = with_moved_submission(&files::read_to_string(&source)?, &was, &now);
                let page = with_name(&page, old_id, id);
                let hidden = is_other.then(|| without_file_notes(&page));
                hidden.unwrap_or(page).into_bytes()
            } else if name == SCORE && is_other {
                let score: Option<Value> = read_json(source.clone())?;
                let mut score = score.unwrap_or_default();
                score["submission"] = id.into();
                for notes in ["ignored_copies", "notes"] {
                    score["build"][notes] = Value::Array(Vec::new());
                }
                json(&score).into_bytes()
            } else if name != STAMP && !is_temporary(name) && is_kept(name) {
                files::read(&source)?
            } else {
                continue;
            };
            self.write_of_entry(id, name, contents)?;
        }
        Ok(())
    }

    /// Returns all results, sorted by id.
    pub fn results(&self) -> Result<Vec<EntryResult>, Error> {
        let ids = self.ids()?;
        let results = ids.iter().map(|id| self.result(id));
        results.filter_map(Result::transpose).collect()
    }

    /// Returns the result of an entry, if any.
    pub fn result(&self, id: &str) -> Result<Option<EntryResult>, Error> {
        let stamp = self.read_stamp(id)?;
        let result = stamp.map(|Stamp { mut result, .. }| {
            id.clone_into(&mut result.id);
            if let EntryOutcome::Graded(score) = &mut result.outcome {
                **score = self.read_score(id)?;
            }
            Ok(result)
        });
        result.transpose()
    }

    /// Saves the last score of every entry as its previous score. If an entry had nothing to grade,
    /// its previous score is removed. It is safe to repeat this after an interruption.
    pub fn save_previous_scores(&self) -> Result<(), Error> {
        for id in self.ids()? {
            let folder = self.entry_folder(&id);
            let path = folder.join(PREVIOUS);
            let last = match self.read_stamp(&id)?.map(|stamp| stamp.result.outcome) {
                Some(EntryOutcome::Graded(_)) => Some(self.read_of_entry(&id, SCORE)?),
                Some(EntryOutcome::NothingToGrade(_)) => {
                    files::remove_if_exists(&path)?;
                    None
                }
                // Regrading the entry failed or was interrupted. If that was in this round, the
                // score was set aside. Otherwise, it is already the previous score.
                Some(EntryOutcome::Fault(_)) | None => {
                    files::read_if_exists(folder.join(REPLACED))?
                }
            };
            if let Some(text) = last {
                self.write_of_entry(&id, PREVIOUS, text)?;
            }
            files::remove_if_exists(folder.join(REPLACED))?;
        }
        Ok(())
    }

    /// Returns an entry's earlier score from the file [`PREVIOUS`] or [`REPLACED`], if there is
    /// one.
    pub fn earlier_score(&self, id: &str, name: &str) -> Result<Option<ScoreSummary>, Error> {
        let path = self.entry_folder(id).join(name);
        let text = files::read_if_exists(&path)?;
        text.map(|text| parse_score(&path, &text)).transpose()
    }

    /// Returns the ids of all entries, sorted.
    pub fn ids(&self) -> Result<Vec<String>, Error> {
        let entries = list_if_exists(&self.folder.join("students"))?;
        let names = entries.iter().filter_map(|path| path.file_name()?.to_str());
        Ok(names.map(str::to_owned).collect())
    }

    fn read_score(&self, id: &str) -> Result<ScoreSummary, Error> {
        let path = self.entry_folder(id).join(SCORE);
        parse_score(&path, &files::read_to_string(&path)?)
    }

    fn read_stamp(&self, id: &str) -> Result<Option<Stamp>, Error> {
        read_json(self.entry_folder(id).join(STAMP))
    }
}

/// Returns the archive with a submission's task files.
pub fn packed(submission: &Submission) -> Vec<u8> {
    archive_bytes(submission).expect("writing to memory succeeds")
}

/// Returns the checksums of the files in an archive. The same files may be compressed differently
/// after an update.
fn checksums(archive: &[u8]) -> Option<Vec<u32>> {
    let mut archive = ZipArchive::new(Cursor::new(archive)).ok()?;
    let files = 0..archive.len();
    let crc32 = |index| Some(archive.by_index(index).ok()?.crc32());
    files.map(crc32).collect()
}

/// Returns the paths of a folder's contents, or none if the folder doesn't exist.
fn list_if_exists(folder: &Path) -> Result<Vec<PathBuf>, PathError> {
    match files::read_dir(folder) {
        Err(error) if error.source.kind() == ErrorKind::NotFound => Ok(Vec::new()),
        listed => listed,
    }
}

fn parse_score(path: &Path, text: &str) -> Result<ScoreSummary, Error> {
    ScoreSummary::parse(text).map_err(|error| damaged(path, &error))
}

/// Returns whether a killed run left a file with this name.
pub fn is_temporary(name: &OsStr) -> bool {
    name.to_string_lossy().starts_with(TEMPORARY_PREFIX)
}

/// Returns the value as indented JSON with a trailing newline.
pub fn json(value: &impl serde::Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("all map keys are strings");
    text.push('\n');
    text
}

/// Reads a JSON file. Returns `None` if it doesn't exist.
fn read_json<T: DeserializeOwned>(path: PathBuf) -> Result<Option<T>, Error> {
    let text = files::read_if_exists(&path)?;
    let value = text.map(|text| serde_json::from_str(&text)).transpose();
    value.map_err(|error| damaged(&path, &error))
}

#[cfg(test)]
pub(crate) mod tests;
