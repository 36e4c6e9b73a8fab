//! `cargo grade --watch`: grades again whenever a file is saved, what failed last time first.

mod save_watcher;
mod screen;

use std::convert::Infallible;
use std::io;

use crate::cli::Arguments;
use crate::desktop;
use crate::error::Error;
use crate::exam::Exam;
use crate::grade::Grader;
use crate::report::text::HintDetail;
use crate::score::Score;
use crate::submission::Submission;
use crate::watch::save_watcher::SaveWatcher;
use crate::watch::screen::{Phase, Screen};

/// Grades until it is stopped from outside, or fails.
pub fn watch(arguments: &Arguments, hints: HintDetail) -> Result<Infallible, Error> {
    let grader = Grader::prepare(arguments)?;
    let saves = SaveWatcher::new(|| grader.collect().ok());
    let mut screen = Screen::open(arguments.task, hints);
    let mut submission = grader.collect()?;
    let mut last: Option<Score> = None;
    let mut page = arguments.open.then(|| grader.files(&submission)).flatten();
    loop {
        match grade_version(&grader, &submission, &saves, last.as_ref(), &mut screen) {
            Ok(score) => {
                last = Some(score);
                // Once: from now on it reloads itself.
                if let Some(files) = page.take() {
                    desktop::show(&files.page);
                }
            }
            // What is on the screen is of an older version: the next round begins at once.
            Err(Interruption::Saved) => {}
            Err(Interruption::Failed(error)) => return Err(error),
        }
        submission = saves.wait_for_change(&submission);
    }
}

/// One version of the submission: what failed last time, then everything. In the end the screen waits.
fn grade_version(
    grader: &Grader,
    submission: &Submission,
    saves: &SaveWatcher,
    last: Option<&Score>,
    screen: &mut Screen,
) -> Result<Score, Interruption> {
    if let Some(last) = last {
        screen.show(last, Phase::Compiling)?;
    }
    let built = grader.build(submission)?;
    let go_on = || match saves.has_changed_since(submission) {
        true => Err(Interruption::Saved),
        false => Ok(()),
    };

    let failed = last.map(|last| failed_items(grader.exam(), last));
    // What passed last time stands until it is asked again.
    let mut shown = grader.pending_score(submission, &built);
    if let (Some(last), Some(failed)) = (last, &failed) {
        shown.tasks.clone_from(&last.tasks);
        shown.update_totals();
        let mut asked = 0;
        grader.run_exam(failed, &built, &mut shown, |score, _| {
            asked += 1;
            let of = failed.items.len();
            screen.show(
                score,
                Phase::RegradingFailed {
                    done: asked,
                    total: of,
                },
            )?;
            go_on()
        })?;
    }

    let mut score = grader.pending_score(submission, &built);
    let exam = grader.exam();
    let mut files = grader.files(submission);
    let mut asked = 0;
    grader.run_exam(exam, &built, &mut score, |score, exhibits| {
        asked += 1;
        let of = exam.items.len();
        if let Some(files) = &mut files {
            files.write_score(score)?;
        }
        match (score.complete, &failed) {
            (true, _) => screen.show(score, Phase::Waiting)?,
            (false, Some(_)) => screen.show(
                &shown,
                Phase::Grading {
                    done: asked,
                    total: of,
                },
            )?,
            (false, None) => screen.show(
                score,
                Phase::Grading {
                    done: asked,
                    total: of,
                },
            )?,
        }
        // Its reader is elsewhere: who looks at the screen does not wait for the page.
        if let Some(files) = &mut files {
            files.write_page(score, exam, exhibits)?;
        }
        go_on()
    })?;
    Ok(score)
}

/// The items that were not passed, and what they need.
fn failed_items(exam: &Exam, last: &Score) -> Exam {
    let lost = last.items().filter(|item| item.points < item.max_points);
    let lost: Vec<&str> = lost.map(|item| item.id.as_str()).collect();
    exam.with_needed_items(|item| lost.contains(&item.id.as_str()))
}

/// Why a round came to no end.
enum Interruption {
    /// A file was saved meanwhile.
    Saved,
    /// The fault is ours.
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
