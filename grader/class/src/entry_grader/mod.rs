//! Grades one entry. A failure affects this entry only.

use std::panic::{AssertUnwindSafe, catch_unwind};

use grader::policy::Policy;
use grader::report::html::Reload;
use grader::report::json;
use grader::report_files::ReportFiles;
use grader::submission::Submission;
use judging::content_hash::ContentHash;
use judging::sanitize::sanitize;

use crate::entry::Entry;
use crate::error::Error;
use crate::input::{NotCollected, collect_submission};
use crate::outcome::{EntryOutcome, EntryResult, ScoreSummary};
use crate::progress::Progress;
use crate::run::Run;
use crate::store::Store;
use crate::submission_grader::SubmissionGrader;

/// The maximum number of attempts to grade an entry. If all of them fail, the entry gets no score
/// in this run.
const ATTEMPTS: usize = 3;
/// The maximum length of a fault's message, in characters.
const MAX_FAULT_CHARS: usize = 2_000;

/// Grades entries and stores their results.
pub struct EntryGrader<'a> {
    /// The grader, which grades every entry with the same exam.
    pub grader: &'a dyn SubmissionGrader,
    /// The output folder.
    pub store: &'a Store,
    /// The run, with the settings that scores depend on.
    pub run: &'a Run,
    /// The display that shows the progress of the run.
    pub progress: &'a Progress,
}

impl EntryGrader<'_> {
    /// Returns the result of an entry: the stored one if it is still valid, otherwise a new one.
    pub fn grade(&self, slot: usize, entry: &Entry) -> Result<EntryResult, Error> {
        let (result, is_new) = match collect_submission(entry, self.grader.handed_out()) {
            Err(NotCollected::MachineFault(why)) => {
                self.store.set_score_aside(&entry.id, self.run.round)?;
                (self.finish(entry, fault(&why), "")?, true)
            }
            Err(NotCollected::NothingToGrade(why)) => {
                let is_new = !self.store.has_nothing_to_grade(&entry.id, &why);
                self.store.set_score_aside(&entry.id, self.run.round)?;
                let result = self.finish(entry, EntryOutcome::NothingToGrade(why), "")?;
                (result, is_new)
            }
            Ok(submission) => {
                let key = cache_key(self.run, self.grader.policy(), &submission);
                match self.store.cached_result(entry, &key) {
                    // The result is saved again, because the rosters may contain new information
                    // about the people.
                    Some(result) => (self.save(result, &key)?, false),
                    None => (
                        self.grade_with_retries(slot, entry, &submission, &key)?,
                        true,
                    ),
                }
            }
        };
        self.progress.finish_entry(slot, &result, is_new);
        Ok(result)
    }

    fn grade_with_retries(
        &self,
        slot: usize,
        entry: &Entry,
        submission: &Submission,
        key: &str,
    ) -> Result<EntryResult, Error> {
        self.store.set_score_aside(&entry.id, self.run.round)?;
        self.store.remove_stamp(&entry.id)?;
        let mut why = String::new();
        for _ in 0..ATTEMPTS {
            // A bug in the grader that one submission triggers must not affect the others.
            let graded = catch_unwind(AssertUnwindSafe(|| {
                self.grade_once(slot, entry, submission)
            }));
            match graded {
                Ok(Ok(score)) => {
                    return self.finish(entry, EntryOutcome::Graded(Box::new(score)), key);
                }
                Ok(Err(error)) => why = error.to_string(),
                Err(_) => why = "the grader panicked, with the message above".to_owned(),
            }
        }
        self.finish(entry, fault(&why), "")
    }

    /// Grades an entry once. Its score and its pages are written when all items are graded.
    fn grade_once(
        &self,
        slot: usize,
        entry: &Entry,
        submission: &Submission,
    ) -> Result<ScoreSummary, Error> {
        self.store.save_submission(&entry.id, submission)?;
        let mut files = ReportFiles::new(&self.store.entry_folder(&entry.id), Reload::Never);
        let show_status = |status: &str| self.progress.set_status(slot, &entry.id, status);
        let (score, page) = self.grader.grade(submission, &mut files, &show_status)?;
        self.store.save_feedback(&entry.id, &page)?;
        ScoreSummary::parse(&json::to_string(&score)).map_err(Error::user)
    }

    fn finish(
        &self,
        entry: &Entry,
        outcome: EntryOutcome,
        key: &str,
    ) -> Result<EntryResult, Error> {
        let result = EntryResult {
            id: entry.id.clone(),
            info: entry.info.clone(),
            outcome,
        };
        self.save(result, key)
    }

    fn save(&self, result: EntryResult, key: &str) -> Result<EntryResult, Error> {
        self.store.save_result(&result, key, self.run.round)?;
        Ok(result)
    }
}

fn fault(why: &str) -> EntryOutcome {
    EntryOutcome::Fault(sanitize(why, MAX_FAULT_CHARS))
}

/// Returns whether an entry needs no grading: it has a valid result, or nothing to grade.
pub fn is_done(grader: &dyn SubmissionGrader, store: &Store, run: &Run, entry: &Entry) -> bool {
    let submission = match collect_submission(entry, grader.handed_out()) {
        Ok(submission) => submission,
        Err(NotCollected::NothingToGrade(_)) => return true,
        Err(NotCollected::MachineFault(_)) => return false,
    };
    let key = cache_key(run, grader.policy(), &submission);
    store.cached_result(entry, &key).is_some()
}

/// Returns the cache key: a hash of everything that the output files of an entry depend on. The
/// only part of the policy that it covers is what students may see, since no other rule affects
/// these files.
fn cache_key(run: &Run, policy: &Policy, submission: &Submission) -> String {
    let mut hash = ContentHash::default();
    let mut part = |bytes: &[u8]| hash.add(bytes);
    let settings = serde_json::to_vec(&run.settings).expect("settings can be serialised");
    part(&settings);
    part(&run.round.to_le_bytes());
    part(format!("{:?}", policy.visibility).as_bytes());
    part(submission.name.as_bytes());
    for (file, text) in &submission.files {
        part(file.name.as_bytes());
        match text {
            Ok(text) => part(text.as_bytes()),
            Err(why) => part(format!("no text: {why}").as_bytes()),
        }
    }
    for note in submission.ignored_copies.iter().chain(&submission.notes) {
        part(note.as_bytes());
    }
    hash.hex()
}

#[cfg(test)]
pub(crate) mod tests;
