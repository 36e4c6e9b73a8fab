//! What stands on the terminal while it is watched: always one page, drawn over the last one in a
//! single write, so that nothing flickers. Where there is no terminal, report after report.

use std::io;

use console::{Term, truncate_str};

use crate::exam::Task;
use crate::report::text::{Hints, report};
use crate::score::Score;

/// How far it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// The compiler is at it.
    Compiling,
    /// What failed last time is being asked.
    FailedFirst {
        /// So many items.
        asked: usize,
        /// Of so many.
        of: usize,
    },
    /// All is being asked.
    Asking {
        /// So many items.
        asked: usize,
        /// Of so many.
        of: usize,
    },
    /// All is asked.
    Waiting,
}

/// Where reports go.
pub struct Screen {
    term: Term,
    only: Option<Task>,
    hints: Hints,
}

impl Screen {
    /// Standard output. With `only`, reports are of that task alone.
    pub fn open(only: Option<Task>, hints: Hints) -> Self {
        let term = Term::buffered_stdout();
        if term.is_term() {
            // What stood there before is kept above.
            let rows = usize::from(term.size().0);
            let _ = term.write_str(&"\n".repeat(rows));
        }
        Screen { term, only, hints }
    }

    /// Shows a score, whole or not.
    pub fn show(&mut self, score: &Score, state: State) -> io::Result<()> {
        let report = report(score, self.only, self.hints);
        if self.term.is_term() {
            self.draw(&line(score, state), &report)
        } else if state == State::Waiting {
            anstream::print!("{report}");
            anstream::println!("{}\n", line(score, state).trim());
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
                .write_line(&colours(&truncate_str(line, columns, "…")))?;
        }
        self.term.clear_to_end_of_screen()?;
        self.term.flush()
    }
}

/// What is said above the report.
fn line(score: &Score, state: State) -> String {
    let name = &score.submission;
    let seconds = |millis: u64| format!("{:.1} s", millis as f64 / 1e3);
    match state {
        State::Compiling => format!("  {name}: compiling …"),
        State::FailedFirst { asked, of } => {
            format!("  {name}: asking what failed before, {asked} of {of} …")
        }
        State::Asking { asked, of } => format!("  {name}: asking everything, {asked} of {of} …"),
        State::Waiting => format!(
            "  {name}: graded in {}; save a file to grade again, Ctrl-C ends",
            seconds(score.timings.build_ms + score.timings.exam_ms)
        ),
    }
}

/// With colours only where they are wanted.
fn colours(line: &str) -> String {
    match anstream::AutoStream::choice(&io::stdout()) {
        anstream::ColorChoice::Never => anstream::adapter::strip_str(line).to_string(),
        anstream::ColorChoice::Auto
        | anstream::ColorChoice::Always
        | anstream::ColorChoice::AlwaysAnsi => line.to_owned(),
    }
}
