//! Grades one entry. A failure only affects this entry.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use grader::policy::Policy;
use grader::report::html::Reload;
use grader::report_files::ReportFiles;
use grader::submission::Submission;
use judging::content_hash::ContentHash;

use crate::entry::Entry;
use crate::error::Error;
use crate::estimate::Estimate;
use crate::input::collect_submission;
use crate::outcome::{EntryOutcome, EntryResult, ScoreSummary};
use crate::progress::Progress;
use crate::queue;
use crate::run::Run;
use crate::store::{FEEDBACK, SUBMISSION, Store, packed};
use crate::submission_grader::SubmissionGrader;

/// The maximum number of attempts to grade an entry. If all of them fail, the entry doesn't get a
/// score in this run.
const ATTEMPTS: usize = 3;

/// Grades entries and stores their results.
pub struct EntryGrader<'a> {
    /// The grader, which uses the same exam for every entry.
    pub grader: &'a dyn SubmissionGrader,
    /// The output folder.
    pub store: &'a Store,
    /// The run, which contains the settings that scores depend on.
    pub run: &'a Run,
}

impl EntryGrader<'_> {
    /// Grades entries, `slots` at a time, and shows the progress. Returns each entry's result and
    /// the time it took.
    pub fn grade_all(
        &self,
        entries: &[Entry],
        slots: usize,
    ) -> Result<Vec<(EntryResult, Duration)>, Error> {
        let progress = Progress::new(entries.len(), slots);
        let results = queue::run(entries, slots, |slot, entry| {
            let started_at = Instant::now();
            let show_status = |status: &str| progress.set_status(slot, &entry.id, status);
            let (result, is_new) = self.grade(entry, &show_status)?;
            progress.finish_entry(slot, &result, is_new);
            Ok((result, started_at.elapsed()))
        });
        progress.finish();
        results.into_iter().collect()
    }

    /// Grades the first entries without a result, two per slot, and measures the time for each.
    pub fn estimate(&self, entries: Vec<Entry>, slots: usize) -> Result<Estimate, Error> {
        let is_open = |entry: &Entry| !self.is_done(entry);
        let mut sample: Vec<Entry> = entries.into_iter().filter(is_open).collect();
        let rest = sample.split_off(sample.len().min(2 * slots));
        let graded = self.grade_all(&sample, slots)?;
        Ok(Estimate {
            times: graded.into_iter().map(|(_, time)| time).collect(),
            remaining: rest.len(),
            slots,
        })
    }

    /// Returns whether an entry need not be graded, because it already has a valid result or there
    /// is nothing to grade.
    fn is_done(&self, entry: &Entry) -> bool {
        match collect_submission(entry, self.grader.handed_out()) {
            Ok(submission) => {
                let key = cache_key(self.run, self.grader.policy(), &submission);
                self.store.cached_score(&entry.id, &key).is_some()
            }
            Err(outcome) => matches!(outcome, EntryOutcome::NothingToGrade(_)),
        }
    }

    /// Returns the result of an entry: the stored one if it is still valid, otherwise a new one.
    /// Also returns whether the result is new.
    fn grade(
        &self,
        entry: &Entry,
        show_status: &dyn Fn(&str),
    ) -> Result<(EntryResult, bool), Error> {
        let mut key = String::new();
        let (outcome, is_new) = match collect_submission(entry, self.grader.handed_out()) {
            Ok(submission) => {
                key = cache_key(self.run, self.grader.policy(), &submission);
                match self.store.cached_score(&entry.id, &key) {
                    Some(score) => (EntryOutcome::Graded(Box::new(score)), false),
                    None => {
                        let graded = self.grade_with_retries(entry, &submission, show_status);
                        (graded?, true)
                    }
                }
            }
            Err(outcome) => {
                self.store
                    .set_score_aside(&entry.id, self.run.round, None)?;
                let is_new = !self.store.has_nothing_to_grade(&entry.id, &outcome);
                (outcome, is_new)
            }
        };
        let result = EntryResult {
            id: entry.id.clone(),
            info: entry.info.clone(),
            outcome,
        };
        // Only scores can stay valid in the next run.
        let key = result.score().map_or("", |_| &key);
        // Save the result again even if it was stored, because the rosters may contain new
        // information about the people.
        self.store.save_result(&result, key, self.run.round)?;
        Ok((result, is_new))
    }

    /// Grades an entry, making several attempts if necessary.
    fn grade_with_retries(
        &self,
        entry: &Entry,
        submission: &Submission,
        show_status: &dyn Fn(&str),
    ) -> Result<EntryOutcome, Error> {
        let round = self.run.round;
        self.store
            .set_score_aside(&entry.id, round, Some(submission))?;
        self.store.remove_stamp(&entry.id)?;
        let mut why = String::new();
        for _ in 0..ATTEMPTS {
            // A grader bug triggered by one submission must not affect the others.
            let graded = catch_unwind(AssertUnwindSafe(|| {
                self.grade_once(entry, submission, show_status)
            }));
            match graded {
                Ok(Ok(score)) => return Ok(EntryOutcome::Graded(Box::new(score))),
                Ok(Err(error)) => why = error.to_string(),
                Err(_) => why = "the grader panicked: see the message above".to_owned(),
            }
        }
        Ok(EntryOutcome::fault(&why))
    }

    /// Makes one attempt to grade an entry. Its score and its pages are written after all items
    /// have been graded.
    fn grade_once(
        &self,
        entry: &Entry,
        submission: &Submission,
        show_status: &dyn Fn(&str),
    ) -> Result<ScoreSummary, Error> {
        let Entry { id, .. } = entry;
        self.store
            .write_of_entry(id, SUBMISSION, packed(submission))?;
        let mut files = ReportFiles::new(&self.store.entry_folder(id), Reload::Never);
        let (score, page) = self.grader.grade(submission, &mut files, show_status)?;
        self.store.write_of_entry(id, FEEDBACK, page)?;
        ScoreSummary::parse(&score.to_json()).map_err(Error::user)
    }
}

/// Returns the cache key: a hash of everything that an entry's output files depend on. The only
/// policy setting it includes is the one that controls what students may see, since no other
/// setting affects these files.
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
            Err(why) => part(format!("no text: {}", why.message(file.name)).as_bytes()),
        }
    }
    for note in submission.ignored_copies.iter().chain(&submission.notes) {
        part(note.as_bytes());
    }
    hash.hex()
}

#[cfg(test)]
mod tests;
