//! What stands on the terminal while it is watched: always one page, drawn over the last one in a
//! single write, so that nothing flickers. Where there is no terminal, report after report.

use std::io;

use console::{Term, truncate_str};

use crate::exam::Task;
use crate::report::text::{HintDetail, report};
use crate::score::Score;

/// How far it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The compiler is at it.
    Compiling,
    /// What failed last time is being asked.
    RegradingFailed {
        /// So many items.
        done: usize,
        /// Of so many.
        total: usize,
    },
    /// All is being asked.
    Grading {
        /// So many items.
        done: usize,
        /// Of so many.
        total: usize,
    },
    /// All is asked.
    Waiting,
}

/// Where reports go.
pub struct Screen {
    term: Term,
    task: Option<Task>,
    hints: HintDetail,
}

impl Screen {
    /// Standard output. With `only`, reports are of that task alone.
    pub fn open(only: Option<Task>, hints: HintDetail) -> Self {
        let term = Term::buffered_stdout();
        if term.is_term() {
            // What stood there before is kept above.
            let rows = usize::from(term.size().0);
            let _ = term.write_str(&"\n".repeat(rows));
        }
        Screen {
            term,
            task: only,
            hints,
        }
    }

    /// Shows a score, whole or not.
    pub fn show(&mut self, score: &Score, state: Phase) -> io::Result<()> {
        let report = report(score, self.task, self.hints);
        if self.term.is_term() {
            self.draw(&status_line(score, state), &report)
        } else if state == Phase::Waiting {
            anstream::print!("{report}");
            anstream::println!("{}\n", status_line(score, state).trim());
            Ok(())
        } else {
            Ok(())
        }
    }

    /// As much as there is room for. A line that were broken would push all others down.
    fn draw(&self, line: &str, report: &str) -> io::Result<()> {
        let (rows, columns) = self.term.size();
        let (rows, columns) = (usize::from(rows), usize::from(columns));
        let fits = rows.saturating_sub(2);
        let lines: Vec<&str> = std::iter::once(line).chain(report.lines()).collect();
        let cut = (lines.len() > fits).then_some("  … the rest: cargo grade --task TASK");
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

/// What is said above the report.
fn status_line(score: &Score, state: Phase) -> String {
    let name = &score.submission;
    let seconds = |millis: u64| format!("{:.1} s", millis as f64 / 1e3);
    match state {
        Phase::Compiling => format!("  {name}: compiling …"),
        Phase::RegradingFailed {
            done: asked,
            total: of,
        } => {
            format!("  {name}: asking what failed before, {asked} of {of} …")
        }
        Phase::Grading {
            done: asked,
            total: of,
        } => format!("  {name}: asking everything, {asked} of {of} …"),
        Phase::Waiting => format!(
            "  {name}: graded in {}; save a file to grade again, Ctrl-C ends",
            seconds(score.timings.build_ms + score.timings.exam_ms)
        ),
    }
}

/// With colours only where they are wanted.
fn strip_unwanted_colours(line: &str) -> String {
    match anstream::AutoStream::choice(&io::stdout()) {
        anstream::ColorChoice::Never => anstream::adapter::strip_str(line).to_string(),
        anstream::ColorChoice::Auto
        | anstream::ColorChoice::Always
        | anstream::ColorChoice::AlwaysAnsi => line.to_owned(),
    }
}
