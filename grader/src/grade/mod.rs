//! Grades a submission, covering every step from the options to the score.

mod build_report;
pub(crate) mod cached_report;
mod grader;
pub mod options;
mod prepared;
pub mod report_files;
pub mod started;

use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

use crate::build::NotCompiled;
use crate::error::Error;
use crate::format::StudentView;
use crate::grade::cached_report::CacheKey;
use crate::grade::options::GradeOptions;
use crate::grade::report_files::ReportFiles;
use crate::machine::printing::print_error_line;
use crate::report::html::Reload;
use crate::score::Score;
use crate::verdict::messages::{file_line, file_message};
use crate::workspace::source_paths::SourcePaths;

pub use build_report::build_report;
pub use grader::Grader;
pub use prepared::{PreparedSubmission, default_folder};

/// The score of a submission and the files it was written to.
#[derive(Debug)]
pub struct GradedSubmission {
    /// The complete score, including what students may not see.
    pub score: Score,
    /// The report's files, if any were written.
    pub files: Option<ReportFiles>,
    /// The part of the score that students may see.
    pub student_view: StudentView,
    /// Hashes of everything the score depends on, or `None` if the report must not be cached.
    pub cache_key: Option<CacheKey>,
}

impl GradedSubmission {
    /// Returns the commands that a format prints to standard output for the CI runner.
    pub fn runner_commands(&self) -> String {
        let files = self.files.as_ref();
        files.map_or(String::new(), |files| {
            files.outputs.runner_commands(&self.student_view)
        })
    }
}

/// Grades the submission named in the options and writes its reports.
pub fn grade(options: &GradeOptions) -> Result<GradedSubmission, Error> {
    grade_prepared(&mut PreparedSubmission::new(options)?)
}

/// Grades a submission that has already been read and writes its reports.
pub fn grade_prepared(prepared: &mut PreparedSubmission) -> Result<GradedSubmission, Error> {
    let (grader, build) = Grader::build_prepared(prepared)?;
    let (options, submission) = (prepared.options, &prepared.submission);
    let preparation = prepared.started_at.elapsed().saturating_sub(build.took);
    let exam = grader.exam();
    let mut files = grader.files(submission, Reload::Never);
    if let Some(files) = &mut files {
        files.outputs = grader.outputs(submission, &files.folder)?;
    }
    let mut score = grader.pending_score(submission, &build);
    let key = CacheKey::new(
        options,
        submission,
        &score.exam.hash,
        &grader.builder_identity(),
    );
    let key = key.filter(|_| build.is_reproducible());
    let mut writing = Duration::ZERO;
    grader.run_exam(exam, &build, &mut score, |score, answers| {
        let started_at = Instant::now();
        let files = files.as_mut();
        let written = files.map_or(Ok(()), |files| {
            files.write(score, exam, answers)?;
            files.outputs.write(&|| grader.student_view(score))?;
            Ok::<(), Error>(())
        });
        writing += started_at.elapsed();
        written
    })?;
    let student_view = grader.student_view(&score);
    if let Some(files) = &files {
        files.write_counted(&student_view)?;
    }
    score.timings.stages.prepare = preparation;
    score.timings.stages.report = writing;
    Ok(GradedSubmission {
        score,
        files,
        student_view,
        cache_key: key,
    })
}

/// Returns a function that prints the first line of each file's compiler error to standard error,
/// once per file. The report that follows contains the complete errors.
fn print_compile_errors(paths: SourcePaths) -> impl FnMut(&BTreeMap<&'static str, NotCompiled>) {
    let mut printed = BTreeSet::new();
    move |files| {
        for (file, why) in files.iter().filter(|(file, _)| printed.insert(**file)) {
            let message = file_message(file, why);
            let first = message.lines().next().unwrap_or_default();
            let line = file_line(why).map(|line| format!(":{line}"));
            let line = line.unwrap_or_default();
            let text = format!("{file}{line}: {first}; grading the rest");
            print_error_line(paths.in_text(&text));
        }
    }
}
