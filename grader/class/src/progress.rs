//! The progress display, on standard error. On a terminal, it shows a bar, plus a line for each
//! submission that is being graded. Otherwise, it prints a line for each finished submission.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicUsize, Ordering};

use grader::printing::{print_error_line, without_commands};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use judging::sanitize::sanitize_line;

use crate::outcome::{EntryOutcome, EntryResult};

/// The progress display of a run.
#[derive(Debug)]
pub struct Progress {
    count: usize,
    done: AtomicUsize,
    failed: AtomicUsize,
    bars: Option<Bars>,
}

#[derive(Debug)]
struct Bars {
    all: ProgressBar,
    slots: Vec<ProgressBar>,
    // Keeps the bars on screen until this is dropped.
    _drawing: MultiProgress,
}

impl Progress {
    /// Creates the display for `count` entries. At most `slots` of them are graded at a time.
    pub fn new(count: usize, slots: usize) -> Self {
        Progress {
            count,
            done: AtomicUsize::new(0),
            failed: AtomicUsize::new(0),
            bars: io::stderr().is_terminal().then(|| make_bars(count, slots)),
        }
    }

    /// Shows the status of the entry that is being graded in a slot.
    pub fn set_status(&self, slot: usize, id: &str, status: &str) {
        if let Some(bar) = self.bars.as_ref().and_then(|bars| bars.slots.get(slot)) {
            bar.set_message(format!("{id}: {status}"));
        }
    }

    /// Shows the result of an entry. `is_new` is false if the result comes from an earlier run.
    pub fn finish_entry(&self, slot: usize, result: &EntryResult, is_new: bool) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        let is_failed = result.score().is_none();
        let failed = usize::from(is_failed);
        let failed = self.failed.fetch_add(failed, Ordering::Relaxed) + failed;
        let line = result_line(result);
        match &self.bars {
            Some(bars) => {
                if let Some(bar) = bars.slots.get(slot) {
                    bar.set_message("");
                }
                bars.all.set_message(format!("{failed} without a score"));
                bars.all.inc(1);
                if is_failed {
                    bars.all.println(without_commands(&line));
                }
            }
            None if is_new => print_error_line(format_args!("[{done}/{}] {line}", self.count)),
            None => {}
        }
    }

    /// Removes the display.
    pub fn finish(self) {
        if let Some(bars) = self.bars {
            bars.slots.iter().for_each(ProgressBar::finish_and_clear);
            bars.all.finish_and_clear();
        }
    }
}

fn result_line(result: &EntryResult) -> String {
    let id = &result.id;
    let line = match &result.outcome {
        EntryOutcome::Graded(score) => format!("{id}: {} of {}", score.points, score.max_points),
        EntryOutcome::NothingToGrade(why) => format!("{id}: nothing to grade: {why}"),
        EntryOutcome::Fault(why) => format!("{id}: not graded, and not the student's fault: {why}"),
    };
    sanitize_line(&line, usize::MAX)
}

fn make_bars(count: usize, slots: usize) -> Bars {
    let style =
        |template: &str| ProgressStyle::with_template(template).expect("the template is valid");
    let drawing = MultiProgress::new();
    let line = || {
        let bar = drawing.add(ProgressBar::new_spinner());
        bar.set_style(style("  {msg}"));
        bar
    };
    let slots = (0..slots).map(|_| line()).collect();
    let all = drawing.add(ProgressBar::new(count as u64));
    all.set_style(style("{bar:30} {pos} of {len}, {eta} left, {msg}"));
    all.set_message("0 without a score");
    Bars {
        all,
        slots,
        _drawing: drawing,
    }
}
