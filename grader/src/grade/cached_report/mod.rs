//! The last report on a submission, stored next to its score and printed again if nothing has
//! changed.
//!
//! A report is only cached if it is about a student's own work, is written to the default folder
//! and has a reproducible result: time-outs, exhausted memory, crashes and compiler failures might
//! not recur. A cached report is never used for a different submission, exam, toolchain or grader,
//! or after one of the report's files has changed.

use std::env;

use judging::content_hash::ContentHash;
use serde::{Deserialize, Serialize};

use crate::build::file_fingerprint;
use crate::build::select_isolation::IsolationRequest;
use crate::grade::options::GradeOptions;
use crate::grade::report_files::ReportFiles;
use crate::inputs::exam_source::ExamSource;
use crate::machine::files::read;
use crate::report::atomic_write;
use crate::score::{Score, Verdict, VerdictKind};
use crate::submission::Submission;

/// Name of the file in the score's folder that stores the cached report.
const RECORD: &str = "earlier.json";

/// Hashes of everything a score depends on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CacheKey {
    /// Hash of the task files and the notes about other files. It is separate because usually
    /// nothing else changes.
    submission: String,
    /// Hash of everything else the score depends on.
    environment: String,
}

/// A cached report, with hashes of its inputs and files.
#[derive(Debug, Serialize, Deserialize)]
pub struct CachedReport {
    key: CacheKey,
    /// Hashes of the report's files.
    file_hashes: Vec<String>,
    /// Total points of the score.
    pub points: u32,
    /// The report as printed on the terminal.
    pub report: String,
}

impl CachedReport {
    /// Reads the cached report stored next to these files, if there is a valid one.
    pub fn read(files: &ReportFiles) -> Option<Self> {
        serde_json::from_slice(&read(files.folder.join(RECORD)).ok()?).ok()
    }

    /// Returns whether the report is about this submission, regardless of the other inputs.
    pub fn is_for(&self, submission: &Submission) -> bool {
        self.key.submission == submission_hash(submission)
    }

    /// Returns whether the report was stored with this key and its files haven't changed since.
    pub fn is_current(&self, key: &CacheKey, files: &ReportFiles) -> bool {
        self.key == *key && self.file_hashes == content_hashes(files)
    }
}

/// Stores a report if its result is reproducible. A failure to write it is ignored.
pub fn store(key: &CacheKey, score: &Score, report: &str, files: &ReportFiles) {
    let record = CachedReport {
        key: key.clone(),
        file_hashes: content_hashes(files),
        points: score.points,
        report: report.to_owned(),
    };
    if score.complete && score.items().all(|item| is_reproducible(&item.verdict)) {
        let text = serde_json::to_string(&record).expect("strings and numbers can be serialised");
        atomic_write::write(&text, &files.folder.join(RECORD)).ok();
    }
}

impl CacheKey {
    /// Returns whether these options allow caching: a student's own work must be graded with the
    /// whole exam, the report must be written to the default folder, and no additional outputs may
    /// be requested.
    pub fn is_cacheable(options: &GradeOptions) -> bool {
        cacheable_options(options).is_some()
    }

    /// Hashes everything a score depends on. Returns `None` if these options don't allow caching,
    /// or if the path of the grader's own executable is unknown.
    pub fn new(
        options: &GradeOptions,
        submission: &Submission,
        exam: &str,
        builder_identity: &str,
    ) -> Option<Self> {
        let options = cacheable_options(options)?;
        let grader = env::current_exe().ok()?;
        let environment = ContentHash::default()
            .with(options.as_bytes())
            .with(format!("{} {}", grader.display(), file_fingerprint(&grader)).as_bytes())
            .with(exam.as_bytes())
            .with(builder_identity.as_bytes());
        Some(CacheKey {
            submission: submission_hash(submission),
            environment: environment.hex(),
        })
    }
}

/// Returns text that contains the options the report depends on, or `None` if a report with these
/// options isn't cached.
fn cacheable_options(options: &GradeOptions) -> Option<String> {
    // Don't use `..` here, so that code with a new option doesn't compile until this function
    // handles it.
    let GradeOptions {
        handed_out,
        submission,
        exam,
        tasks,
        policy,
        gradescope_metadata,
        dependents,
        isolation,
        budget,
        hints,
        out,
        formats,
    } = options;
    let is_whole_exam = tasks.is_all();
    let is_default_policy = policy.is_none() && gradescope_metadata.is_none();
    let is_default_output = out.is_none() && formats.is_empty();
    // Standard input can only be read once.
    let is_repeatable = *exam != ExamSource::StandardInput;
    (*isolation == IsolationRequest::OwnWork
        && is_whole_exam
        && is_default_policy
        && is_default_output
        && is_repeatable)
        .then(|| {
            format!(
                "{:?}",
                (handed_out, submission, exam, dependents, budget, hints)
            )
        })
}

fn submission_hash(submission: &Submission) -> String {
    let Submission {
        handed_out,
        name,
        files,
        ignored_copies,
        notes,
    } = submission;
    let files: Vec<_> = files.iter().map(|(file, text)| (file.name, text)).collect();
    let all = format!("{:?}", (handed_out, name, files, ignored_copies, notes));
    ContentHash::default().with(all.as_bytes()).hex()
}

/// Returns the hashes of the files' contents. The hash of an unreadable file is empty.
fn content_hashes(files: &ReportFiles) -> Vec<String> {
    let hash = |bytes: Vec<u8>| ContentHash::default().with(&bytes).hex();
    let hashes = files.paths().map(|path| read(path).map(hash));
    hashes.map(Result::unwrap_or_default).collect()
}

/// Returns whether grading again would give the same verdict.
fn is_reproducible(verdict: &Verdict) -> bool {
    !matches!(verdict.kind(), VerdictKind::NoAnswer | VerdictKind::Pending)
}

#[cfg(test)]
mod tests;
