//! Grading one entry: whatever happens, it is this entry's matter alone.

use std::panic::{AssertUnwindSafe, catch_unwind};

use grader::error::Error;
use grader::format::{Format, FormatContext};
use grader::grade::Grader;
use grader::policy::Policy;
use grader::report::html::Reload;
use grader::report::json;
use grader::report_files::ReportFiles;
use grader::sanitize::sanitize;
use grader::submission::Submission;

use crate::entry::Entry;
use crate::input::collect_submission;
use crate::outcome::{EntryOutcome, EntryResult, EntryState, ScoreSummary};
use crate::progress::Progress;
use crate::run::Run;
use crate::store::{Store, StoreError};

/// How often an entry is tried before its fault counts as one.
const ATTEMPTS: usize = 3;
/// The most characters that are kept of a fault's words.
const MAX_FAULT_CHARS: usize = 2_000;

/// What grades entries.
pub struct EntryGrader<'a> {
    /// Builds, asks, judges.
    pub grader: &'a Grader<'a>,
    /// Where results go.
    pub store: &'a Store,
    /// What scores follow from.
    pub run: &'a Run,
    /// Who is told.
    pub progress: &'a Progress,
}

impl EntryGrader<'_> {
    /// What becomes of the entry: as it is kept from an earlier time, or graded now.
    pub fn grade(&self, slot: usize, entry: &Entry) -> Result<EntryResult, StoreError> {
        let (row, is_new) = match collect_submission(entry) {
            Err(why) => {
                let is_new = !self
                    .store
                    .has_state(&entry.id, &EntryState::NothingToGrade(why.clone()));
                let row = self.finish(entry, EntryOutcome::NothingToGrade(why), "")?;
                (row, is_new)
            }
            Ok(submission) => {
                let key = cache_key(self.run, self.grader.policy(), &submission);
                match self.store.cached_result(entry, &key) {
                    // The list may have learnt something of whose it is.
                    Some(row) => (self.save(row, &key)?, false),
                    None => (
                        self.grade_with_retries(slot, entry, &submission, &key)?,
                        true,
                    ),
                }
            }
        };
        self.progress.finish_entry(slot, &row, is_new);
        Ok(row)
    }

    fn grade_with_retries(
        &self,
        slot: usize,
        entry: &Entry,
        submission: &Submission,
        key: &str,
    ) -> Result<EntryResult, StoreError> {
        self.store.remove_stamp(&entry.id)?;
        let mut fault = String::new();
        for _ in 0..ATTEMPTS {
            // A mistake in the grader that one submission brings about is not the others' matter.
            let graded = catch_unwind(AssertUnwindSafe(|| {
                self.grade_once(slot, entry, submission)
            }));
            match graded {
                Ok(Ok(told)) => {
                    return self.finish(entry, EntryOutcome::Graded(Box::new(told)), key);
                }
                Ok(Err(why)) => fault = why,
                Err(_) => fault = "the grader panicked; its words are above".to_owned(),
            }
        }
        self.finish(
            entry,
            EntryOutcome::Fault(sanitize(&fault, MAX_FAULT_CHARS)),
            "",
        )
    }

    /// Grades, and writes score and page when they are complete.
    fn grade_once(
        &self,
        slot: usize,
        entry: &Entry,
        submission: &Submission,
    ) -> Result<ScoreSummary, String> {
        let said = |error: Error| error.to_string();
        self.progress.set_status(slot, &entry.id, "compiling");
        let built = self.grader.build(submission).map_err(said)?;
        let exam = self.grader.exam();
        let count = exam.items.len();
        let mut files = ReportFiles::new(&self.store.entry_folder(&entry.id), Reload::Never);
        let mut score = self.grader.pending_score(submission, &built);
        let mut asked = 0;
        let examined = self
            .grader
            .run_exam(exam, &built, &mut score, |score, exhibits| {
                asked += 1;
                match score.complete {
                    true => files.write(score, exam, exhibits),
                    false => {
                        let words = format!("{asked} of {count}");
                        self.progress.set_status(slot, &entry.id, &words);
                        Ok(())
                    }
                }
            });
        examined.map_err(said)?;
        let seen = self.grader.student_view(&score);
        if let Some(page) = Format::Html.render(&seen, &FormatContext::default()) {
            let kept = self.store.save_feedback(&entry.id, &page);
            kept.map_err(|error| error.to_string())?;
        }
        ScoreSummary::parse(&json::to_string(&score)).map_err(|error| error.to_string())
    }

    fn finish(
        &self,
        entry: &Entry,
        outcome: EntryOutcome,
        key: &str,
    ) -> Result<EntryResult, StoreError> {
        let row = EntryResult {
            id: entry.id.clone(),
            info: entry.info.clone(),
            outcome,
        };
        self.save(row, key)
    }

    fn save(&self, row: EntryResult, key: &str) -> Result<EntryResult, StoreError> {
        self.store.save_result(&row, key)?;
        Ok(row)
    }
}

/// The name of all that an entry's files follow from. Of the policy that is what students see: what
/// points count for changes no score, and no file of an entry.
fn cache_key(run: &Run, policy: &Policy, submission: &Submission) -> String {
    let mut hasher = blake2b_simd::State::new();
    let mut part = |bytes: &[u8]| {
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(bytes);
    };
    let settings = serde_json::to_vec(&run.settings).expect("settings are text");
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
    for note in &submission.notes {
        part(note.as_bytes());
    }
    hasher.finalize().to_hex()[..32].to_owned()
}
