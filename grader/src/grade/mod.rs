//! The main job, from a command line to a score.

mod build_report;
mod grader;
mod resolve;

use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

use crate::build::NotCompiled;
use crate::cached_report::CacheKey;
use crate::cli::Arguments;
use crate::error::Error;
use crate::format::StudentView;
use crate::report_files::ReportFiles;
use crate::score::Score;
use crate::verdict::file_message;

pub use grader::{BuiltSubmission, Grader};
pub use resolve::{budget, builder, collect, default_folder};

/// A submission's score, and where it was written, if it was.
#[derive(Debug)]
pub struct GradedSubmission {
    /// The score.
    pub score: Score,
    /// The files that tell it.
    pub files: Option<ReportFiles>,
    /// As much of it as students may see.
    pub student_view: StudentView,
    /// What it follows from, if it may be said again without grading.
    pub cache_key: Option<CacheKey>,
}

impl GradedSubmission {
    /// What a runner is to be told on standard output, if one was asked for.
    pub fn commands(&self) -> Option<String> {
        self.files
            .as_ref()?
            .outputs
            .runner_commands(&self.student_view)
    }
}

/// Loads the exam, collects the submission, builds it, asks, judges, scores.
pub fn grade(arguments: &Arguments) -> Result<GradedSubmission, Error> {
    let began = Instant::now();
    let tell = print_compile_errors();
    let (grader, submission, built) = Grader::prepare_and_build(arguments, tell)?;
    let prepared = began.elapsed().saturating_sub(built.took());
    let exam = grader.exam();
    let mut files = grader.files(&submission);
    if let Some(files) = &mut files {
        files.outputs = grader.outputs(&submission, &files.folder)?;
    }
    let mut score = grader.pending_score(&submission, &built);
    let key = CacheKey::new(
        arguments,
        &submission,
        &score.exam.hash,
        &grader.builder_identity(),
    );
    let key = key.filter(|_| built.is_reproducible());
    let mut writing = Duration::ZERO;
    grader.run_exam(exam, &built, &mut score, |score, exhibits| {
        let began = Instant::now();
        let files = files.as_mut();
        let written = files.map_or(Ok(()), |files| {
            files.write(score, exam, exhibits)?;
            files.outputs.write(&|| grader.student_view(score))?;
            Ok::<(), Error>(())
        });
        writing += began.elapsed();
        written
    })?;
    score.timings.stages.prepare = prepared;
    score.timings.stages.report = writing;
    let seen = grader.student_view(&score);
    Ok(GradedSubmission {
        score,
        files,
        student_view: seen,
        cache_key: key,
    })
}

/// On standard error, each file once and in short: the report that follows has all the compiler's
/// words.
fn print_compile_errors() -> impl FnMut(&BTreeMap<&'static str, NotCompiled>) {
    let mut said = BTreeSet::new();
    move |files| {
        for (file, why) in files.iter().filter(|(file, _)| said.insert(**file)) {
            let message = file_message(file, why);
            let first = message.lines().next().unwrap_or_default();
            anstream::eprintln!("{file}: {first}; grading the rest");
        }
    }
}
