//! The terminal output of `--watch`: a single page, redrawn in one write so that it does not
//! flicker. Without a terminal, reports are printed one after the other.

use std::io;

use console::{Term, truncate_str};

use crate::report::text::{HintDetail, report};
use crate::score::Score;
use crate::task_selection::TaskSelection;

/// The current phase of grading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The submission is being compiled.
    Compiling,
    /// The items that failed last time are being tested.
    RegradingFailed {
        /// The number of items tested so far.
        done: usize,
        /// The number of items to test.
        total: usize,
    },
    /// All items are being tested.
    Grading {
        /// The number of items tested so far.
        done: usize,
        /// The number of items to test.
        total: usize,
    },
    /// Grading is finished, and the watcher is waiting for a file to change.
    Waiting,
}

/// The terminal, file or pipe that shows the reports.
pub struct Screen {
    term: Term,
    tasks: TaskSelection,
    hints: HintDetail,
}

impl Screen {
    /// Opens standard output. Reports show the selected tasks only.
    pub fn open(tasks: TaskSelection, hints: HintDetail) -> Self {
        let term = Term::buffered_stdout();
        if term.is_term() {
            // Scrolls up what is on the screen, so that it is not overwritten.
            let rows = usize::from(term.size().0);
            let _ = term.write_str(&"\n".repeat(rows));
        }
        Screen { term, tasks, hints }
    }

    /// Shows a score, complete or not.
    pub fn show(&mut self, score: &Score, phase: Phase) -> io::Result<()> {
        let report = report(score, &self.tasks, self.hints);
        if self.term.is_term() {
            self.draw(&status_line(score, phase), &report)
        } else if phase == Phase::Waiting {
            anstream::print!("{report}");
            anstream::println!("{}\n", status_line(score, phase).trim());
            Ok(())
        } else {
            Ok(())
        }
    }

    /// Draws as much as fits on the screen. Lines are truncated, because a wrapped line would push
    /// the others down.
    fn draw(&self, line: &str, report: &str) -> io::Result<()> {
        let (rows, columns) = self.term.size();
        let (rows, columns) = (usize::from(rows), usize::from(columns));
        let fits = rows.saturating_sub(2);
        let lines: Vec<&str> = std::iter::once(line).chain(report.lines()).collect();
        let cut = (lines.len() > fits).then_some("  … to see the rest: cargo grade --task TASK");
        let kept = lines
            .len()
            .min(fits - usize::from(cut.is_some() && fits > 0));

        self.term.move_cursor_to(0, 0)?;
        for line in lines[..kept].iter().copied().chain(cut) {
            self.term.clear_line()?;
            self.term
                .write_line(&strip_unwanted_colours(&truncate_str(line, columns, "…")))?;
        }
        self.term.clear_to_end_of_screen()?;
        self.term.flush()
    }
}

/// Returns the status line, which is shown above the report.
fn status_line(score: &Score, phase: Phase) -> String {
    let name = &score.submission;
    let seconds = |millis: u64| format!("{:.1} s", millis as f64 / 1e3);
    match phase {
        Phase::Compiling => format!("  {name}: compiling …"),
        Phase::RegradingFailed { done, total } => {
            format!("  {name}: testing what failed before, {done} of {total} …")
        }
        Phase::Grading { done, total } => {
            format!("  {name}: testing everything, {done} of {total} …")
        }
        Phase::Waiting => format!(
            "  {name}: graded in {}; save a file to grade again, or press Ctrl-C to stop",
            seconds(score.timings.build_ms + score.timings.exam_ms)
        ),
    }
}

/// Removes the colours from a line unless the output should have them.
fn strip_unwanted_colours(line: &str) -> String {
    match anstream::AutoStream::choice(&io::stdout()) {
        anstream::ColorChoice::Never => anstream::adapter::strip_str(line).to_string(),
        anstream::ColorChoice::Auto
        | anstream::ColorChoice::Always
        | anstream::ColorChoice::AlwaysAnsi => line.to_owned(),
    }
}
