//! The terminal output of `--watch`: a single page, redrawn in one write so that it doesn't
//! flicker. Without a terminal, reports are printed one after another.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::io;

use console::{Term, truncate_str};
use judging::assignment::Task;

use crate::grade::options::GradeOptions;
use crate::machine::printing::{print, without_commands};
use crate::report::next_step::next_step;
use crate::report::text::{ItemOrder, OldResults, ReportParts, report_parts, short_table};
use crate::score::{Score, Verdict};
use crate::watch::layout::{Page, fit};
use crate::workspace::source_paths::SourcePaths;

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

/// The terminal, file or pipe that the reports are written to.
pub struct Screen<'a> {
    term: Term,
    options: &'a GradeOptions,
    paths: SourcePaths,
    /// The size of the page on the screen, in rows and columns.
    drawn_size: Cell<(u16, u16)>,
}

impl<'a> Screen<'a> {
    /// Opens standard output. Reports only show the selected tasks.
    pub fn open(options: &'a GradeOptions, paths: SourcePaths) -> Self {
        let term = Term::buffered_stdout();
        if term.is_term() {
            // Scroll up the contents of the screen so that they aren't overwritten.
            let rows = usize::from(term.size().0);
            let _ = term.write_str(&"\n".repeat(rows));
        }
        Screen {
            term,
            options,
            paths,
            drawn_size: Cell::default(),
        }
    }

    /// Shows that the first version is being compiled.
    pub fn announce(&self, submission: &str) -> io::Result<()> {
        if !self.term.is_term() {
            return Ok(());
        }
        let status = format!("  {submission}: compiling …");
        self.draw(&Page {
            status: &status,
            report: &ReportParts::default(),
            next: "",
            short_table: "",
            rest: &|_| String::new(),
        })
    }

    /// Shows a score, complete or not. The items in `old` haven't been graded since the last save.
    pub fn show(&self, score: &Score, phase: Phase, old: &BTreeSet<String>) -> io::Result<()> {
        if !self.term.is_term() && phase != Phase::Waiting {
            return Ok(());
        }
        let GradeOptions { tasks, hints, .. } = self.options;
        let old_results = OldResults {
            items: Some(old),
            build: phase == Phase::Compiling,
        };
        let order = ItemOrder::FirstOnTop;
        let report = report_parts(score, tasks, *hints, old_results, order);
        let next = if phase == Phase::Waiting {
            next_step(score, tasks, self.options.handed_out.assignment)
        } else {
            String::new()
        };
        let status = status_line(score, phase, !old.is_empty());
        if self.term.is_term() {
            let mut report = report;
            for detail in &mut report.details {
                detail.text = self.paths.in_text(&detail.text).into_owned();
            }
            let page = Page {
                status: &status,
                report: &report,
                next: &next,
                short_table: &short_table(score, tasks),
                rest: &|task| format!("  … the rest: {}", command_for_the_rest(score, task)),
            };
            self.draw(&page)
        } else {
            let details = report.details_text();
            let details = self.paths.in_text(&details);
            let ReportParts {
                headline, table, ..
            } = report;
            let status = status.trim();
            print(format_args!(
                "\n{headline}{table}{details}\n{next}{status}\n\n"
            ));
            Ok(())
        }
    }

    /// Shows the final results again if the terminal's size has changed.
    pub fn show_if_resized(&self, score: &Score) -> io::Result<()> {
        if self.term.is_term() && self.term.size() != self.drawn_size.get() {
            self.show(score, Phase::Waiting, &BTreeSet::new())?;
        }
        Ok(())
    }

    /// Draws as much as fits on the screen. Lines are truncated, because a wrapped line would push
    /// down the lines below it.
    fn draw(&self, page: &Page) -> io::Result<()> {
        let (rows, columns) = self.term.size();
        self.drawn_size.set((rows, columns));
        let columns = usize::from(columns);
        self.term.move_cursor_to(0, 0)?;
        for line in fit(page, usize::from(rows).saturating_sub(1)) {
            self.term.clear_line()?;
            let line = without_commands(&line);
            self.term
                .write_line(&strip_unwanted_colours(&truncate_str(&line, columns, "…")))?;
        }
        self.term.clear_to_end_of_screen()?;
        self.term.flush()
    }
}

/// Returns the command that shows everything about this task or, if no task is given, about the
/// first task that fails.
fn command_for_the_rest(score: &Score, task: Option<Task>) -> String {
    let fails = |verdict: &Verdict| !matches!(verdict, Verdict::Pass | Verdict::Pending);
    let mut tasks = score.tasks.iter();
    let failing = tasks.find(|task| task.items.iter().any(|item| fails(&item.verdict)));
    let first = || failing.or(score.tasks.first()).map(|task| task.id);
    match task.or_else(first) {
        Some(task) => score.rerun_command.task(task.id()),
        None => "cargo grade".to_owned(),
    }
}

/// Returns the status line, which is shown above the report.
fn status_line(score: &Score, phase: Phase, has_old_results: bool) -> String {
    let name = &score.submission;
    let old = if has_old_results {
        " (grey: before this save)"
    } else {
        ""
    };
    match phase {
        Phase::Compiling => format!("  {name}: compiling …{old}"),
        Phase::RegradingFailed { done, total } => {
            format!("  {name}: testing what failed before, {done} of {total} …{old}")
        }
        Phase::Grading { done, total } => {
            format!("  {name}: testing everything, {done} of {total} …{old}")
        }
        Phase::Waiting => {
            let seconds = (score.timings.build_ms + score.timings.exam_ms) as f64 / 1e3;
            format!(
                "  {name}: graded in {seconds:.1} s; save a file to grade again, or press Ctrl-C to \
                 stop"
            )
        }
    }
}

/// Removes the colours from a line unless they should be shown.
fn strip_unwanted_colours(line: &str) -> String {
    match anstream::AutoStream::choice(&io::stdout()) {
        anstream::ColorChoice::Never => anstream::adapter::strip_str(line).to_string(),
        anstream::ColorChoice::Auto
        | anstream::ColorChoice::Always
        | anstream::ColorChoice::AlwaysAnsi => line.to_owned(),
    }
}
