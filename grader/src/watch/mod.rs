//! `cargo grade --watch`: grades again whenever a file is saved, starting with the items that
//! failed last time.

pub mod save_watcher;
mod screen;

use std::convert::Infallible;
use std::io;

use judging::exam::Exam;

use crate::desktop;
use crate::error::Error;
use crate::grade::Grader;
use crate::options::GradeOptions;
use crate::report::html::Reload;
use crate::report_files::ReportFiles;
use crate::score::Score;
use crate::submission::Submission;
use crate::watch::save_watcher::SaveWatcher;
use crate::watch::screen::{Phase, Screen};

/// Grades until the process is stopped or an error occurs. With `open`, opens the report's page in a
/// browser once.
pub fn watch(options: &GradeOptions, open: bool) -> Result<Infallible, Error> {
    let grader = Grader::prepare(options)?;
    let watcher = SaveWatcher::new(|| grader.collect().ok());
    let mut screen = Screen::open(options.tasks.clone(), options.hints);
    let mut submission = grader.collect()?;
    let mut last: Option<Score> = None;
    let mut page = open.then(|| files(&grader, &submission)).flatten();
    loop {
        match grade_version(&grader, &submission, &watcher, last.as_ref(), &mut screen) {
            Ok(score) => {
                last = Some(score);
                // Only once: from now on, the page reloads itself.
                if let Some(files) = page.take() {
                    desktop::show(&files.page);
                }
            }
            // The screen shows an older version, so grade the new one at once.
            Err(Interruption::Saved) => {}
            Err(Interruption::Failed(error)) => return Err(error),
        }
        submission = watcher.wait_for_change(&submission);
    }
}

/// Grades one version of the submission: first the items that failed last time, then all of them.
/// Afterwards the screen shows that the grader is waiting for the next version.
fn grade_version(
    grader: &Grader,
    submission: &Submission,
    watcher: &SaveWatcher,
    last: Option<&Score>,
    screen: &mut Screen,
) -> Result<Score, Interruption> {
    if let Some(last) = last {
        screen.show(last, Phase::Compiling)?;
    }
    let built = grader.build(submission)?;
    let stop_if_saved = || {
        if watcher.has_changed_since(submission) {
            Err(Interruption::Saved)
        } else {
            Ok(())
        }
    };

    let failed = last.map(|last| failed_items(grader.exam(), last));
    // Items that passed last time are shown as passed until they are tested again.
    let mut shown = grader.pending_score(submission, &built);
    if let (Some(last), Some(failed)) = (last, &failed) {
        shown.tasks.clone_from(&last.tasks);
        shown.update_totals();
        let mut done = 0;
        grader.run_exam(failed, &built, &mut shown, |score, _| {
            done += 1;
            let total = failed.items.len();
            screen.show(score, Phase::RegradingFailed { done, total })?;
            stop_if_saved()
        })?;
    }

    let mut score = grader.pending_score(submission, &built);
    let exam = grader.exam();
    let mut files = files(grader, submission);
    let mut done = 0;
    grader.run_exam(exam, &built, &mut score, |score, answers| {
        done += 1;
        let total = exam.items.len();
        if let Some(files) = &mut files {
            files.write_score(score)?;
        }
        match (score.complete, &failed) {
            (true, _) => screen.show(score, Phase::Waiting)?,
            (false, Some(_)) => screen.show(&shown, Phase::Grading { done, total })?,
            (false, None) => screen.show(score, Phase::Grading { done, total })?,
        }
        // The page is written after the screen is updated, so that the screen does not wait for it.
        if let Some(files) = &mut files {
            files.write_page(score, exam, answers)?;
        }
        stop_if_saved()
    })?;
    Ok(score)
}

/// Returns the report's files. Their page reloads itself when the user returns to it.
fn files(grader: &Grader, submission: &Submission) -> Option<ReportFiles> {
    grader.files(submission, Reload::WhileUnfocused)
}

/// Returns an exam of the items that lost points, and of the items that they depend on.
fn failed_items(exam: &Exam, last: &Score) -> Exam {
    let lost = last.items().filter(|item| item.points < item.max_points);
    let lost: Vec<&str> = lost.map(|item| item.id.as_str()).collect();
    exam.with_needed_items(|item| lost.contains(&item.id.as_str()))
}

/// Reasons why grading a version was interrupted.
enum Interruption {
    /// A file was saved in the meantime.
    Saved,
    /// The grader failed.
    Failed(Error),
}

impl From<Error> for Interruption {
    fn from(error: Error) -> Self {
        Interruption::Failed(error)
    }
}

impl From<io::Error> for Interruption {
    fn from(error: io::Error) -> Self {
        Interruption::Failed(error.into())
    }
}
