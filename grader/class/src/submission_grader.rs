//! The interface between a class and the processes that grade a submission. A class uses the grader
//! only through this trait, so that the handling of results can be tested without compiling
//! anything.

use std::collections::BTreeMap;
use std::env;
use std::path;

use grader::error::Error;
use grader::files;
use grader::format::{FormatContext, html};
use grader::grade::Grader;
use grader::handed_out::HandedOut;
use grader::options::GradeOptions;
use grader::policy::Policy;
use grader::report_files::ReportFiles;
use grader::score::Score;
use grader::submission::Submission;
use judging::content_hash::file_hash;

use crate::run::Settings;
use crate::store::SUBMISSION;

/// Grades submissions, all with the same exam and the same options.
pub trait SubmissionGrader: Sync {
    /// Returns the assignment.
    fn handed_out(&self) -> &'static HandedOut;

    /// Returns the course's policy.
    fn policy(&self) -> &Policy;

    /// Returns everything that scores depend on, other than the submissions.
    fn settings(&self) -> Result<Settings, Error>;

    /// Returns the maximum points for each item in the exam, keyed by the item's id.
    fn item_points(&self) -> BTreeMap<String, u32>;

    /// Grades a submission and writes its score and its page for staff. Calls `show_status` with
    /// the progress. Returns the score and the page that the student may see.
    fn grade(
        &self,
        submission: &Submission,
        files: &mut ReportFiles,
        show_status: &dyn Fn(&str),
    ) -> Result<(Score, String), Error>;
}

impl SubmissionGrader for Grader<'_> {
    fn handed_out(&self) -> &'static HandedOut {
        self.handed_out()
    }

    fn policy(&self) -> &Policy {
        self.policy()
    }

    fn settings(&self) -> Result<Settings, Error> {
        let exam = self.exam_name();
        // Hash the executable itself, because any change to it, such as a build with another
        // compiler, may change a score.
        let program = env::current_exe()?;
        Ok(Settings {
            exam: exam.id.clone(),
            exam_hash: exam.hash.clone(),
            grader: file_hash(&files::read(program)?),
            built_with: self.builder_identity(),
            isolation: self.isolation().to_string(),
            options: options_of_scores(self.options()),
        })
    }

    fn item_points(&self) -> BTreeMap<String, u32> {
        let items = self.exam().items.iter();
        items.map(|item| (item.id.clone(), item.points)).collect()
    }

    fn grade(
        &self,
        submission: &Submission,
        files: &mut ReportFiles,
        show_status: &dyn Fn(&str),
    ) -> Result<(Score, String), Error> {
        show_status("compiling");
        let built = self.build(submission)?;
        let exam = self.exam();
        let count = exam.items.len();
        let mut score = self.pending_score(submission, &built);
        // The input may be an archive that is unpacked for this run only, or loose files.
        let archive = files.folder.join(SUBMISSION);
        let archive = path::absolute(&archive).unwrap_or(archive);
        score.rerun_command.submission = Some(archive);
        let mut done = 0;
        self.run_exam(exam, &built, &mut score, |score, answers| {
            done += 1;
            if score.complete {
                files.write(score, exam, answers)
            } else {
                show_status(&format!("{done} of {count}"));
                Ok(())
            }
        })?;
        let page = html::render(&self.student_view(&score), &FormatContext::default());
        Ok((score, page))
    }
}

/// Returns the options that scores depend on, as text. Leaves out options that are stored as
/// separate settings or that `cargo class` doesn't have.
fn options_of_scores(options: &GradeOptions) -> String {
    // Don't use `..` here, so that adding an option is a compile error until this function handles
    // it.
    let GradeOptions {
        dependents,
        budget,
        handed_out,
        // stored as separate settings
        exam: _,
        isolation: _,
        // applied to finished scores, apart from what students may see, which is part of the cache
        // key
        policy: _,
        // options of a single submission
        submission: _,
        tasks: _,
        gradescope_metadata: _,
        hints: _,
        out: _,
        formats: _,
    } = options;
    format!("{handed_out:?} {dependents:?} {budget:?}")
}
