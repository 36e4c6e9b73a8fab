//! The progress display, on standard error. On a terminal, it shows a bar, plus a line for each
//! submission that is being graded. Otherwise, it prints a line for each finished submission.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicUsize, Ordering};

use grader::printing::{print_error_line, without_commands};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use judging::sanitize::sanitize_line;

use crate::outcome::{EntryOutcome, EntryResult};

/// The progress display of a run. Its bars are only shown on a terminal.
#[derive(Debug)]
pub struct Progress {
    count: usize,
    done: AtomicUsize,
    failed: AtomicUsize,
    all: ProgressBar,
    slots: Vec<ProgressBar>,
}

impl Progress {
    /// Creates the display for `count` entries. At most `slots` of them are graded at a time.
    pub fn new(count: usize, slots: usize) -> Self {
        let drawing = MultiProgress::new();
        let line = |_| drawing.add(ProgressBar::new_spinner().with_style(style("  {msg}")));
        let slots = (0..slots).map(line).collect();
        let all = ProgressBar::new(count as u64).with_message("0 without a score");
        let all = all.with_style(style("{bar:30} {pos} of {len}, {eta} left, {msg}"));
        Progress {
            count,
            done: AtomicUsize::new(0),
            failed: AtomicUsize::new(0),
            all: drawing.add(all),
            slots,
        }
    }

    /// Shows the status of the entry that is being graded in a slot.
    pub fn set_status(&self, slot: usize, id: &str, status: &str) {
        self.slots[slot].set_message(format!("{id}: {status}"));
    }

    /// Shows the result of an entry. `is_new` is false if the result comes from an earlier run.
    pub fn finish_entry(&self, slot: usize, result: &EntryResult, is_new: bool) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        let is_failed = result.score().is_none();
        let failed = usize::from(is_failed);
        let failed = self.failed.fetch_add(failed, Ordering::Relaxed) + failed;
        let line = result_line(result);
        self.slots[slot].set_message("");
        self.all.set_message(format!("{failed} without a score"));
        self.all.inc(1);
        if is_failed {
            self.all.println(without_commands(&line));
        }
        if is_new && !io::stderr().is_terminal() {
            print_error_line(format_args!("[{done}/{}] {line}", self.count));
        }
    }

    /// Removes the display.
    pub fn finish(self) {
        self.slots.iter().for_each(ProgressBar::finish_and_clear);
        self.all.finish_and_clear();
    }
}

fn result_line(result: &EntryResult) -> String {
    let id = &result.id;
    let line = match &result.outcome {
        EntryOutcome::Graded(score) => format!("{id}: {} of {}", score.points, score.max_points),
        EntryOutcome::NothingToGrade(why) => format!("{id}: nothing to grade: {why}"),
        EntryOutcome::Fault(why) => {
            format!("{id}: not graded because of a problem with the grader or the machine: {why}")
        }
    };
    sanitize_line(&line, usize::MAX)
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is valid")
}
