//! What was said of a submission when it was last graded, kept beside its score.
//!
//! One's own work only, in its usual place, and only where all follows from what was compared: what
//! ran out of time or memory, crashed, or was not what the compiler could digest may go otherwise
//! next time. Nothing kept here is ever taken for another submission, exam, toolchain or grader, nor
//! if the files that it tells of are no longer what they were.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::build::{ContentHash, file_fingerprint};
use crate::cli::Arguments;
use crate::report::atomic_write;
use crate::report_files::ReportFiles;
use crate::score::{Score, Verdict};
use crate::submission::Submission;

/// Beside the score.
const RECORD: &str = "earlier.json";

/// What a score follows from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CacheKey {
    /// The five files, and what is said of others. Apart, since this is what mostly changes.
    submission: String,
    /// All else.
    environment: String,
}

/// What was said of a submission.
#[derive(Debug, Serialize, Deserialize)]
pub struct CachedReport {
    key: CacheKey,
    /// The names of the contents of the files beside this one.
    file_hashes: Vec<String>,
    /// The score's points.
    pub points: u32,
    /// What stood on the terminal.
    pub report: String,
}

impl CachedReport {
    /// What is kept beside these files, of whatever it is.
    pub fn read(files: &ReportFiles) -> Option<Self> {
        serde_json::from_slice(&fs::read(files.folder.join(RECORD)).ok()?).ok()
    }

    /// Whether it is of this submission, whatever the circumstances.
    pub fn is_for(&self, submission: &Submission) -> bool {
        self.key.submission == submission_hash(submission)
    }

    /// Whether it is of just this, and the files that it tells of are as they were.
    pub fn is_current(&self, key: &CacheKey, files: &ReportFiles) -> bool {
        self.key == *key && self.file_hashes == content_hashes(files)
    }
}

/// Keeps what is said of a submission for the next time, if that can be said again. That it can not
/// be kept is no reason to stop.
pub fn store(key: &CacheKey, score: &Score, told: &str, files: &ReportFiles) {
    let earlier = CachedReport {
        key: key.clone(),
        file_hashes: content_hashes(files),
        points: score.points,
        report: told.to_owned(),
    };
    if score.complete && score.items().all(|item| is_reproducible(&item.verdict)) {
        let text = serde_json::to_string(&earlier).expect("texts and numbers");
        atomic_write::write(&text, &files.folder.join(RECORD)).ok();
    }
}

impl CacheKey {
    /// Whether anything is kept: of one's own work, whole, in its usual place and form.
    pub fn is_cacheable(arguments: &Arguments) -> bool {
        let exam = arguments.exam.as_deref();
        !arguments.untrusted
            && arguments.isolation.is_none()
            && arguments.task.is_none()
            && arguments.out.is_none()
            && arguments.format.is_empty()
            && arguments.policy.is_none()
            && arguments.gradescope_metadata.is_none()
            && !arguments.watch
            && !arguments.timings
            // Standard input can be read only once.
            && exam != Some(Path::new("-"))
    }

    /// `None` where nothing is kept.
    pub fn new(
        arguments: &Arguments,
        submission: &Submission,
        exam: &str,
        built_with: &str,
    ) -> Option<Self> {
        if !CacheKey::is_cacheable(arguments) {
            return None;
        }
        let grader = env::current_exe().ok()?;
        let options = (
            &arguments.submission,
            &arguments.exam,
            arguments.no_reference,
            arguments.hints,
            arguments.cpu_limit,
        );
        let circumstances = ContentHash::default()
            .with(format!("{options:?}").as_bytes())
            .with(format!("{} {}", grader.display(), file_fingerprint(&grader)).as_bytes())
            .with(exam.as_bytes())
            .with(built_with.as_bytes());
        Some(CacheKey {
            submission: submission_hash(submission),
            environment: circumstances.hex(),
        })
    }
}

fn submission_hash(submission: &Submission) -> String {
    let Submission { name, files, notes } = submission;
    let files = files.iter().map(|(file, text)| (file.name, text));
    let all = format!("{:?}", (name, files.collect::<Vec<_>>(), notes));
    ContentHash::default().with(all.as_bytes()).hex()
}

/// The names of what the files hold; an empty one of what can not be read.
fn content_hashes(files: &ReportFiles) -> Vec<String> {
    let paths: Vec<PathBuf> = files.paths().map(Path::to_owned).collect();
    let name = |bytes: Vec<u8>| ContentHash::default().with(&bytes).hex();
    let names = paths.iter().map(|path| fs::read(path).map(name));
    names.map(Result::unwrap_or_default).collect()
}

/// Whether it would be the same on any day.
fn is_reproducible(verdict: &Verdict) -> bool {
    match verdict {
        Verdict::Pass
        | Verdict::Partial
        | Verdict::Wrong
        | Verdict::Panicked
        | Verdict::Unimplemented
        | Verdict::NotCompiled
        | Verdict::Blocked { .. } => true,
        Verdict::TimedOut
        | Verdict::OutOfMemory
        | Verdict::Crashed
        | Verdict::Protocol
        | Verdict::Pending => false,
    }
}
