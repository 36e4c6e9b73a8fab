//! The files that a score is written to.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use judging::exam::Exam;

use crate::error::Error;
use crate::format::StudentView;
use crate::format::outputs::Outputs;
use crate::report::answers::ReportAnswers;
use crate::report::atomic_write;
use crate::report::html::{self, Reload};
use crate::score::Score;

/// Minimum time between two writes of the score file during an exam. Writing a score takes about a
/// millisecond, which is as long as most items take. If the grader is killed, at most the results
/// of one interval are missing from the file.
const SCORE_INTERVAL: Duration = Duration::from_millis(100);
/// Minimum time between two writes of the page. Writing it takes longer than testing most items.
const PAGE_INTERVAL: Duration = Duration::from_secs(1);

/// The report files of one submission.
#[derive(Debug)]
pub struct ReportFiles {
    /// The score file, for programs.
    pub score: PathBuf,
    /// The HTML page, for people.
    pub page: PathBuf,
    score_written_at: Option<Instant>,
    /// The files for grading platforms.
    pub outputs: Outputs,
    /// The folder of the report. The files for grading platforms are also written there, unless a
    /// platform requires another location.
    pub folder: PathBuf,
    page_written_at: Option<Instant>,
    reload: Reload,
}

impl ReportFiles {
    /// Returns the report files in a folder. `reload` says whether the page reloads itself.
    pub fn new(folder: &Path, reload: Reload) -> Self {
        ReportFiles {
            score: folder.join("score.json"),
            page: folder.join("report.html"),
            score_written_at: None,
            outputs: Outputs::default(),
            folder: folder.to_owned(),
            page_written_at: None,
            reload,
        }
    }

    /// Returns the paths of all files.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        let own = [self.score.as_path(), self.page.as_path()];
        own.into_iter().chain(self.outputs.paths())
    }

    /// Writes the score file and the page, if they are due: after the first item, at the end, and
    /// at intervals in between.
    pub fn write(
        &mut self,
        score: &Score,
        exam: &Exam,
        answers: &ReportAnswers,
    ) -> Result<(), Error> {
        self.write_score(score)?;
        self.write_page(score, exam, answers)
    }

    /// Writes the score file if it is due.
    pub fn write_score(&mut self, score: &Score) -> Result<(), Error> {
        if score.complete || is_due(self.score_written_at, SCORE_INTERVAL) {
            atomic_write::write(score.to_json(), &self.score)?;
            self.score_written_at = Some(Instant::now());
        }
        Ok(())
    }

    /// Writes the page if it is due.
    pub fn write_page(
        &mut self,
        score: &Score,
        exam: &Exam,
        answers: &ReportAnswers,
    ) -> Result<(), Error> {
        if score.complete || is_due(self.page_written_at, PAGE_INTERVAL) {
            let page = html::page(score, exam, answers, self.reload);
            atomic_write::write(&page, &self.page)?;
            self.page_written_at = Some(Instant::now());
        }
        Ok(())
    }

    /// Inserts sentences about the final points into the finished page and chooses its next step.
    /// The page is rendered without them, because a policy never changes a score.
    pub fn write_counted(&self, view: &StudentView) -> Result<(), Error> {
        let texts = view.counted_text();
        let written = html::write_counted(&self.page, texts.as_slice(), &view.failing);
        Ok(written?)
    }
}

fn is_due(written_at: Option<Instant>, interval: Duration) -> bool {
    written_at.is_none_or(|at| at.elapsed() >= interval)
}
