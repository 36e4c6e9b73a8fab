//! `cargo grade --watch`: grades again whenever a file is saved, what failed last time first.

mod saves;
mod screen;

use std::convert::Infallible;
use std::io;

use crate::cli::Arguments;
use crate::desktop;
use crate::error::Error;
use crate::exam::Exam;
use crate::grade::Grader;
use crate::report::text::Hints;
use crate::score::Score;
use crate::submission::Submission;
use crate::watch::saves::Saves;
use crate::watch::screen::{Screen, State};

/// Grades until it is stopped from outside, or fails.
pub fn watch(arguments: &Arguments, hints: Hints) -> Result<Infallible, Error> {
    let grader = Grader::prepare(arguments)?;
    let saves = Saves::of(|| grader.collect().ok());
    let mut screen = Screen::open(arguments.task, hints);
    let mut submission = grader.collect()?;
    let mut last: Option<Score> = None;
    let mut page = arguments.open.then(|| grader.files(&submission)).flatten();
    loop {
        match round(&grader, &submission, &saves, last.as_ref(), &mut screen) {
            Ok(score) => {
                last = Some(score);
                // Once: from now on it reloads itself.
                if let Some(files) = page.take() {
                    desktop::show(&files.page);
                }
            }
            // What is on the screen is of an older version: the next round begins at once.
            Err(Stopped::Saved) => {}
            Err(Stopped::Failed(error)) => return Err(error),
        }
        submission = saves.next(&submission);
    }
}

/// One version of the submission: what failed last time, then everything. In the end the screen waits.
fn round(
    grader: &Grader,
    submission: &Submission,
    saves: &Saves,
    last: Option<&Score>,
    screen: &mut Screen,
) -> Result<Score, Stopped> {
    if let Some(last) = last {
        screen.show(last, State::Compiling)?;
    }
    let built = grader.build(submission)?;
    let go_on = || match saves.since(submission) {
        true => Err(Stopped::Saved),
        false => Ok(()),
    };

    let failed = last.map(|last| failed(grader.exam(), last));
    // What passed last time stands until it is asked again.
    let mut shown = grader.unasked(submission, &built);
    if let (Some(last), Some(failed)) = (last, &failed) {
        shown.tasks.clone_from(&last.tasks);
        shown.total();
        let mut asked = 0;
        grader.examine(failed, &built, &mut shown, |score, _| {
            asked += 1;
            let of = failed.items.len();
            screen.show(score, State::FailedFirst { asked, of })?;
            go_on()
        })?;
    }

    let mut score = grader.unasked(submission, &built);
    let exam = grader.exam();
    let mut files = grader.files(submission);
    let mut asked = 0;
    grader.examine(exam, &built, &mut score, |score, exhibits| {
        asked += 1;
        let of = exam.items.len();
        if let Some(files) = &mut files {
            files.write_score(score)?;
        }
        match (score.complete, &failed) {
            (true, _) => screen.show(score, State::Waiting)?,
            (false, Some(_)) => screen.show(&shown, State::Asking { asked, of })?,
            (false, None) => screen.show(score, State::Asking { asked, of })?,
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
fn failed(exam: &Exam, last: &Score) -> Exam {
    let lost = last.items().filter(|item| item.points < item.max_points);
    let lost: Vec<&str> = lost.map(|item| item.id.as_str()).collect();
    exam.with_what_it_needs(|item| lost.contains(&item.id.as_str()))
}

/// Why a round came to no end.
enum Stopped {
    /// A file was saved meanwhile.
    Saved,
    /// The fault is ours.
    Failed(Error),
}

impl From<Error> for Stopped {
    fn from(error: Error) -> Self {
        Stopped::Failed(error)
    }
}

impl From<io::Error> for Stopped {
    fn from(error: io::Error) -> Self {
        Stopped::Failed(error.into())
    }
}
