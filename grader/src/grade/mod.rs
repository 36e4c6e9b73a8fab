//! The main job, from a command line to a score.

mod files_said;
mod grader;
mod named;

use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

use crate::build::NotCompiled;
use crate::cli::Arguments;
use crate::earlier::Key;
use crate::error::Error;
use crate::files::Files;
use crate::format::Seen;
use crate::score::Score;
use crate::verdict::file_message;

pub use grader::{Built, Grader};
pub use named::{budget, builder, collect, usual_folder};

/// A submission's score, and where it was written, if it was.
#[derive(Debug)]
pub struct Graded {
    /// The score.
    pub score: Score,
    /// The files that tell it.
    pub files: Option<Files>,
    /// As much of it as students may see.
    pub seen: Seen,
    /// What it follows from, if it may be said again without grading.
    pub key: Option<Key>,
}

impl Graded {
    /// What a runner is to be told on standard output, if one was asked for.
    pub fn commands(&self) -> Option<String> {
        self.files.as_ref()?.outputs.commands(&self.seen)
    }
}

/// Loads the exam, collects the submission, builds it, asks, judges, scores.
pub fn grade(arguments: &Arguments) -> Result<Graded, Error> {
    let began = Instant::now();
    let tell = say_what_does_not_compile();
    let (grader, submission, built) = Grader::prepare_building(arguments, tell)?;
    let prepared = began.elapsed().saturating_sub(built.took());
    let exam = grader.exam();
    let mut files = grader.files(&submission);
    if let Some(files) = &mut files {
        files.outputs = grader.outputs(&submission, &files.folder)?;
    }
    let mut score = grader.unasked(&submission, &built);
    let key = Key::of(
        arguments,
        &submission,
        &score.exam.hash,
        &grader.built_with(),
    );
    let key = key.filter(|_| built.is_settled());
    let mut writing = Duration::ZERO;
    grader.examine(exam, &built, &mut score, |score, exhibits| {
        let began = Instant::now();
        let files = files.as_mut();
        let written = files.map_or(Ok(()), |files| {
            files.write(score, exam, exhibits)?;
            files.outputs.write(&|| grader.seen(score))?;
            Ok::<(), Error>(())
        });
        writing += began.elapsed();
        written
    })?;
    score.timings.stages.prepare = prepared;
    score.timings.stages.report = writing;
    let seen = grader.seen(&score);
    Ok(Graded {
        score,
        files,
        seen,
        key,
    })
}

/// On standard error, each file once and in short: the report that follows has all the compiler's
/// words.
fn say_what_does_not_compile() -> impl FnMut(&BTreeMap<&'static str, NotCompiled>) {
    let mut said = BTreeSet::new();
    move |files| {
        for (file, why) in files.iter().filter(|(file, _)| said.insert(**file)) {
            let message = file_message(file, why);
            let first = message.lines().next().unwrap_or_default();
            anstream::eprintln!("{file}: {first}; grading the rest");
        }
    }
}
