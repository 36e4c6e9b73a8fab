//! The contents of a results folder, read without the class's own code, and the invariants
//! that must hold at any time, regardless of how the last run ended.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::recorded_grader::{EXAMS, exam_hash, score_file};

/// A score that is known to be right, identified by the version of the submission and the exam.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ScoreId {
    /// The version of the submission.
    pub version: u32,
    /// The exam.
    pub exam: usize,
}

/// The files of an entry.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Files {
    /// The stamp, `entry.json`.
    pub stamp: Option<Value>,
    /// The score.
    pub score: Option<ScoreId>,
    /// The score from before a regrade.
    pub previous: Option<ScoreId>,
    /// The score of an earlier version in the same round.
    pub replaced: Option<ScoreId>,
}

impl Files {
    /// Returns the score if the stamp says that it is complete.
    pub fn graded(&self) -> Option<ScoreId> {
        self.score.filter(|_| self.state() == Some("graded"))
    }

    /// Returns the state in the stamp.
    pub fn state(&self) -> Option<&str> {
        self.stamp.as_ref()?["state"].as_str()
    }

    /// Returns the round in the stamp.
    pub fn round(&self) -> Option<u64> {
        self.stamp.as_ref()?["round"].as_u64()
    }
}

/// A results folder.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Observed {
    /// `run.json`.
    pub run: Option<Value>,
    /// The entries.
    pub entries: BTreeMap<String, Files>,
    /// Whether the class's page lists final grades that changed.
    pub has_changed_grades: bool,
}

impl Observed {
    /// Returns the current round, or 0 in a new folder.
    pub fn round(&self) -> u64 {
        self.run
            .as_ref()
            .map_or(0, |run| run["round"].as_u64().unwrap())
    }

    /// Returns the exam of the current round.
    pub fn exam(&self) -> Option<usize> {
        let hash = self.run.as_ref()?["settings"]["exam_hash"].as_str()?;
        (0..EXAMS).find(|exam| exam_hash(*exam) == hash)
    }

    /// Returns whether the last run in this folder ended normally.
    pub fn is_finished(&self) -> bool {
        self.state() == Some("finished")
    }

    /// Returns whether a regrade has started but never ended normally.
    pub fn is_unfinished_regrade(&self) -> bool {
        let run = self.run.as_ref();
        let was_finished = matches!(self.state(), Some("finished" | "resumed"));
        run.is_some_and(|run| !run["before"].is_null()) && !was_finished
    }

    /// If the folder contains a list of this kind, returns the last component of the path that was
    /// given on the command line.
    pub fn list(&self, kind: &str) -> Option<&str> {
        let path = self.run.as_ref()?["lists"][kind]["given_as"].as_str()?;
        path.rsplit('/').next()
    }

    fn state(&self) -> Option<&str> {
        self.run.as_ref()?["state"].as_str()
    }
}

/// The cache keys seen in stamps, and the scores that they were seen with.
pub type Keys = BTreeMap<String, (String, ScoreId)>;

/// Reads a folder. The error says what is wrong with it.
pub fn observe(folder: &Path, keys: &mut Keys) -> Result<Observed, String> {
    let mut observed = Observed {
        run: read_json(&folder.join("run.json"))?,
        ..Observed::default()
    };
    let grades = read_json(&folder.join("final-grades.json"))?;
    observed.has_changed_grades = grades.is_some_and(|grades| !grades["before"].is_null());
    for name in ["class.json", "drift.json"] {
        read_json(&folder.join(name))?;
    }
    check_page(&folder.join("class.html"))?;
    for path in list(&folder.join("students")) {
        let id = path.file_name().unwrap().to_string_lossy().into_owned();
        let files = observe_entry(&path, &id)?;
        check_key(&id, &files, keys)?;
        observed.entries.insert(id, files);
    }
    Ok(observed)
}

fn observe_entry(folder: &Path, id: &str) -> Result<Files, String> {
    let stamp = read_json(&folder.join("entry.json"))?;
    let score = read_score(&folder.join("score.json"), id)?;
    let is_graded = |stamp: &Value| stamp["state"] == "graded";
    let is_graded = stamp.as_ref().is_some_and(is_graded);
    for page in ["report.html", "feedback.html"] {
        let path = folder.join(page);
        check_page(&path)?;
        if is_graded && !path.exists() {
            return Err(format!("{} is missing beside a stamp", path.display()));
        }
    }
    if is_graded && score.is_none() {
        return Err(format!("{id} has a stamp, and no score"));
    }
    Ok(Files {
        stamp,
        score,
        previous: read_score(&folder.join("previous.json"), id)?,
        replaced: read_score(&folder.join("replaced.json"), id)?,
    })
}

/// Checks that a cache key always belongs to the same score.
fn check_key(id: &str, files: &Files, keys: &mut Keys) -> Result<(), String> {
    let (Some(stamp), Some(score)) = (&files.stamp, files.graded()) else {
        return Ok(());
    };
    let key = stamp["key"].as_str().unwrap_or_default().to_owned();
    let known = keys.entry(key).or_insert_with(|| (id.to_owned(), score));
    if *known == (id.to_owned(), score) {
        Ok(())
    } else {
        Err(format!(
            "the stamp of {id} is that of {known:?}, but the score is {score:?}"
        ))
    }
}

/// Returns the score in a file. Checks that the entire file belongs to this score.
fn read_score(path: &Path, id: &str) -> Result<Option<ScoreId>, String> {
    let Some(file) = read_json(path)? else {
        return Ok(None);
    };
    let hash = file["exam"]["hash"].as_str().unwrap_or_default();
    let message = file["tasks"][0]["items"][0]["message"].as_str();
    let version = message.and_then(|text| text.rsplit(' ').next()?.parse().ok());
    let exam = (0..EXAMS).find(|exam| exam_hash(*exam) == hash);
    let (Some(version), Some(exam)) = (version, exam) else {
        return Err(format!("{} is no score: {file}", path.display()));
    };
    let text = fs::read_to_string(path).unwrap();
    if text == score_file(id, version, exam) {
        Ok(Some(ScoreId { version, exam }))
    } else {
        Err(format!(
            "{} is not version {version} of {id}",
            path.display()
        ))
    }
}

fn read_json(path: &Path) -> Result<Option<Value>, String> {
    let Ok(text) = fs::read_to_string(path) else {
        return Ok(None);
    };
    let value = serde_json::from_str(&text);
    value
        .map(Some)
        .map_err(|error| format!("{}: {error}", path.display()))
}

fn check_page(path: &Path) -> Result<(), String> {
    match fs::read_to_string(path) {
        Ok(page) if !page.trim_end().ends_with("</html>") => {
            Err(format!("{} is half a page", path.display()))
        }
        Ok(_) | Err(_) => Ok(()),
    }
}

/// Returns the paths in a folder, sorted. Empty if the folder doesn't exist.
pub fn list(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// Returns the contents of all files below a folder, keyed by relative path.
pub fn all_files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut open = vec![folder.to_owned()];
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(list(&path));
        } else if path.exists() {
            let name = path.strip_prefix(folder).unwrap().to_owned();
            files.insert(name, fs::read(&path).unwrap());
        }
    }
    files
}
