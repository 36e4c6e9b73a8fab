//! Grading one entry: whatever happens, it is this entry's matter alone.

use std::panic::{AssertUnwindSafe, catch_unwind};

use grader::error::Error;
use grader::files::Files;
use grader::format::{Around, Format};
use grader::grade::Grader;
use grader::policy::Policy;
use grader::report::html::Reload;
use grader::report::json;
use grader::submission::Submission;
use grader::tame::tame;

use crate::entry::Entry;
use crate::input::collect;
use crate::outcome::{Outcome, Row, State, Told};
use crate::progress::Progress;
use crate::run::Run;
use crate::store::{Store, StoreError};

/// How often an entry is tried before its fault counts as one.
const ATTEMPTS: usize = 3;
/// The most characters that are kept of a fault's words.
const LONGEST: usize = 2_000;

/// What grades entries.
pub struct Work<'a> {
    /// Builds, asks, judges.
    pub grader: &'a Grader<'a>,
    /// Where results go.
    pub store: &'a Store,
    /// What scores follow from.
    pub run: &'a Run,
    /// Who is told.
    pub progress: &'a Progress,
}

impl Work<'_> {
    /// What becomes of the entry: as it is kept from an earlier time, or graded now.
    pub fn row(&self, slot: usize, entry: &Entry) -> Result<Row, StoreError> {
        let (row, is_new) = match collect(entry) {
            Err(why) => {
                let is_new = !self
                    .store
                    .is_known(&entry.id, &State::NoSubmission(why.clone()));
                let row = self.done(entry, Outcome::NoSubmission(why), "")?;
                (row, is_new)
            }
            Ok(submission) => {
                let key = key(self.run, self.grader.policy(), &submission);
                match self.store.graded(entry, &key) {
                    // The list may have learnt something of whose it is.
                    Some(row) => (self.kept(row, &key)?, false),
                    None => (self.graded(slot, entry, &submission, &key)?, true),
                }
            }
        };
        self.progress.end(slot, &row, is_new);
        Ok(row)
    }

    fn graded(
        &self,
        slot: usize,
        entry: &Entry,
        submission: &Submission,
        key: &str,
    ) -> Result<Row, StoreError> {
        self.store.open(&entry.id)?;
        let mut fault = String::new();
        for _ in 0..ATTEMPTS {
            // A mistake in the grader that one submission brings about is not the others' matter.
            let graded = catch_unwind(AssertUnwindSafe(|| self.score(slot, entry, submission)));
            match graded {
                Ok(Ok(told)) => return self.done(entry, Outcome::Graded(Box::new(told)), key),
                Ok(Err(why)) => fault = why,
                Err(_) => fault = "the grader panicked; its words are above".to_owned(),
            }
        }
        self.done(entry, Outcome::Fault(tame(&fault, LONGEST)), "")
    }

    /// Grades, and writes score and page when they are complete.
    fn score(&self, slot: usize, entry: &Entry, submission: &Submission) -> Result<Told, String> {
        let said = |error: Error| error.to_string();
        self.progress.at(slot, &entry.id, "compiling");
        let built = self.grader.build(submission).map_err(said)?;
        let exam = self.grader.exam();
        let count = exam.items.len();
        let mut files = Files::of(&self.store.entry(&entry.id), Reload::Never);
        let mut score = self.grader.unasked(submission, &built);
        let mut asked = 0;
        let examined = self
            .grader
            .examine(exam, &built, &mut score, |score, exhibits| {
                asked += 1;
                match score.complete {
                    true => files.write(score, exam, exhibits),
                    false => {
                        let words = format!("{asked} of {count}");
                        self.progress.at(slot, &entry.id, &words);
                        Ok(())
                    }
                }
            });
        examined.map_err(said)?;
        let seen = self.grader.seen(&score);
        if let Some(page) = Format::Html.text(&seen, &Around::default()) {
            let kept = self.store.keep_feedback(&entry.id, &page);
            kept.map_err(|error| error.to_string())?;
        }
        Told::read(&json::text(&score)).map_err(|error| error.to_string())
    }

    fn done(&self, entry: &Entry, outcome: Outcome, key: &str) -> Result<Row, StoreError> {
        let row = Row {
            id: entry.id.clone(),
            about: entry.about.clone(),
            outcome,
        };
        self.kept(row, key)
    }

    fn kept(&self, row: Row, key: &str) -> Result<Row, StoreError> {
        self.store.keep(&row, key)?;
        Ok(row)
    }
}

/// The name of all that an entry's files follow from. Of the policy that is what students see: what
/// points count for changes no score, and no file of an entry.
fn key(run: &Run, policy: &Policy, submission: &Submission) -> String {
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
