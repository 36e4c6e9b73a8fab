//! `cargo grade --watch`: grades again whenever a file is saved, starting with the items that
//! failed last time.

mod layout;
pub mod save_watcher;
mod screen;

use std::collections::BTreeSet;
use std::convert::Infallible;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use judging::exam::Exam;

use crate::build::Build;
use crate::error::Error;
use crate::grade::options::GradeOptions;
use crate::grade::report_files::ReportFiles;
use crate::grade::{Grader, PreparedSubmission};
use crate::handed_out::HandedOut;
use crate::machine::desktop;
use crate::report::html::Reload;
use crate::score::Score;
use crate::submission::Submission;
use crate::watch::save_watcher::{POLL_INTERVAL, SaveWatcher};
use crate::watch::screen::{Phase, Screen};

/// Grades until the process is stopped or an error occurs. If `open` is true, opens the report's
/// page in a browser once.
pub fn watch(options: &GradeOptions, open: bool) -> Result<Infallible, Error> {
    // Report a missing submission before compiling anything.
    let mut submission = PreparedSubmission::new(options)?.submission;
    let grader = Grader::prepare(options)?;
    let watcher = SaveWatcher::new(|| grader.collect().ok());
    let screen = Screen::open(options, grader.source_paths());
    let mut last: Option<Score> = None;
    let mut page = open.then(|| files(&grader, &submission)).flatten();
    loop {
        match grade_version(&grader, &submission, last.as_ref(), &screen) {
            Ok(score) => {
                // Open the page only once. From then on, it reloads itself.
                if let Some(files) = page.take() {
                    desktop::show(&files.page);
                }
                // A write error is reported at the next save.
                submission = watcher.wait_for_change_while(&submission, || {
                    let _ = screen.show_if_resized(&score);
                });
                last = Some(score);
            }
            // Don't use `wait_for_change` here. If the save is undone in the meantime, the same
            // version must be graded again, because the screen only shows part of its results.
            Err(Interruption::Saved) => submission = watcher.wait_for_version(),
            Err(Interruption::Failed(error)) => return Err(error),
        }
    }
}

/// Grades one version of the submission, stopping if a new version is saved.
fn grade_version(
    grader: &Grader,
    submission: &Submission,
    last: Option<&Score>,
    screen: &Screen,
) -> Result<Score, Interruption> {
    match last {
        Some(last) => screen.show(last, Phase::Compiling, &all_items(last))?,
        None => screen.announce(&submission.name)?,
    }
    let build = grader.build(submission)?;
    let is_done = AtomicBool::new(false);
    thread::scope(|scope| {
        // End a hanging program immediately instead of waiting for its item to end.
        scope.spawn(|| {
            let has_changed = || grader.collect().is_ok_and(|now| now != *submission);
            while !is_done.load(Ordering::Relaxed) {
                if has_changed() {
                    return build.interrupt.request();
                }
                thread::sleep(POLL_INTERVAL);
            }
        });
        let graded = run_exams(grader, submission, &build, last, screen);
        is_done.store(true, Ordering::Relaxed);
        graded
    })
}

/// Runs the items that failed last time and then all items. Afterwards the screen shows that the
/// grader is waiting for the next version.
fn run_exams(
    grader: &Grader,
    submission: &Submission,
    build: &Build,
    last: Option<&Score>,
    screen: &Screen,
) -> Result<Score, Interruption> {
    // Check this before showing results, because the results of an interrupted item are wrong.
    let stop_if_saved = || {
        if build.interrupt.is_requested() {
            Err(Interruption::Saved)
        } else {
            Ok(())
        }
    };
    let exam = grader.exam();
    let mut shown = grader.pending_score(submission, build);
    let mut old = BTreeSet::new();
    if let Some(last) = last {
        let pending = std::mem::replace(&mut shown.tasks, last.tasks.clone());
        for (task, pending) in shown.tasks.iter_mut().zip(pending) {
            task.method = pending.method;
            task.methods = pending.methods;
            task.warnings = pending.warnings;
        }
        shown.update_totals();
        old = all_items(last);
        let failed = failed_items(exam, last);
        let mut ids = ids_in_order(&failed, grader.handed_out());
        let mut done = 0;
        let total = failed.items.len();
        screen.show(&shown, Phase::RegradingFailed { done, total }, &old)?;
        grader.run_exam(&failed, build, &mut shown, |score, _| {
            stop_if_saved()?;
            if let Some(id) = ids.next() {
                old.remove(id);
                done += 1;
            }
            screen.show(score, Phase::RegradingFailed { done, total }, &old)?;
            Ok::<_, Interruption>(())
        })?;
    }

    let mut score = grader.pending_score(submission, build);
    let mut files = files(grader, submission);
    let mut ids = ids_in_order(exam, grader.handed_out());
    let mut done = 0;
    if last.is_none() {
        let total = exam.items.len();
        screen.show(&score, Phase::Grading { done, total }, &old)?;
    }
    grader.run_exam(exam, build, &mut score, |score, answers| {
        stop_if_saved()?;
        if let Some(id) = ids.next() {
            done += 1;
            // The failed items were graded above, so their hints are known.
            if old.remove(id)
                && let Some(item) = score.items().find(|item| item.id == id)
            {
                shown.record(item.clone());
                shown.update_totals();
            }
        }
        let total = exam.items.len();
        if let Some(files) = &mut files {
            files.write_score(score)?;
        }
        match (score.complete, last) {
            (true, _) => screen.show(score, Phase::Waiting, &BTreeSet::new())?,
            (false, Some(_)) => screen.show(&shown, Phase::Grading { done, total }, &old)?,
            (false, None) => screen.show(score, Phase::Grading { done, total }, &old)?,
        }
        // Write the page after updating the screen, so that the screen doesn't wait for it.
        if let Some(files) = &mut files {
            files.write_page(score, exam, answers)?;
        }
        Ok::<_, Interruption>(())
    })?;
    Ok(score)
}

fn all_items(score: &Score) -> BTreeSet<String> {
    score.items().map(|item| item.id.clone()).collect()
}

/// Returns the ids of an exam's items in grading order.
fn ids_in_order<'a>(exam: &'a Exam, handed_out: &HandedOut) -> impl Iterator<Item = &'a str> {
    let tasks = exam.tasks_in_order(handed_out.assignment).into_iter();
    let of_task = move |task| exam.items.iter().filter(move |item| item.task == task);
    tasks.flat_map(of_task).map(|item| item.id.as_str())
}

/// Returns the report's files. The report's page reloads itself while its window isn't focused.
fn files(grader: &Grader, submission: &Submission) -> Option<ReportFiles> {
    grader.files(submission, Reload::WhileUnfocused)
}

/// Returns an exam with the items that lost points and the items they depend on.
fn failed_items(exam: &Exam, last: &Score) -> Exam {
    let lost = last.items().filter(|item| item.points < item.max_points);
    let lost: Vec<&str> = lost.map(|item| item.id.as_str()).collect();
    exam.with_needed_items(|item| lost.contains(&item.id.as_str()))
}

/// Reasons for interrupting the grading of a version.
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
