//! What is written of a score, and where.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::Error;
use crate::exam::Exam;
use crate::format::outputs::Outputs;
use crate::report::html::{self, Reload};
use crate::report::{atomic_write, json};
use crate::report_answers::ReportAnswers;
use crate::score::Score;

/// While the exam is asked, the files are written no more often than this. Most items take a
/// millisecond, and so does writing a score: whoever is stopped loses no more than so much.
const SCORE_INTERVAL: Duration = Duration::from_millis(100);
/// The same for the page, which takes longer than most items.
const PAGE_INTERVAL: Duration = Duration::from_secs(1);

/// The files of one submission's score.
#[derive(Debug)]
pub struct ReportFiles {
    /// For programs.
    pub score: PathBuf,
    /// For people.
    pub page: PathBuf,
    score_written_at: Option<Instant>,
    /// For platforms.
    pub outputs: Outputs,
    /// Where they are, unless a platform says otherwise.
    pub folder: PathBuf,
    page_written_at: Option<Instant>,
    reload: Reload,
}

impl ReportFiles {
    /// Those in this folder.
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

    /// Those in this folder, of a page that stays as it is.
    pub fn without_reload(folder: &Path) -> Self {
        ReportFiles::new(folder, Reload::Never)
    }

    /// All of them.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        let own = [self.score.as_path(), self.page.as_path()];
        own.into_iter().chain(self.outputs.paths())
    }

    /// Writes both: at the first item and at the end, and between them after each item that took its
    /// time.
    pub fn write(
        &mut self,
        score: &Score,
        exam: &Exam,
        exhibits: &ReportAnswers,
    ) -> Result<(), Error> {
        self.write_score(score)?;
        self.write_page(score, exam, exhibits)
    }

    /// Writes the score file, if it is time to.
    pub fn write_score(&mut self, score: &Score) -> Result<(), Error> {
        if score.complete || is_due(self.score_written_at, SCORE_INTERVAL) {
            write(&self.score, &json::to_string(score))?;
            self.score_written_at = Some(Instant::now());
        }
        Ok(())
    }

    /// Writes the page, if it is time to.
    pub fn write_page(
        &mut self,
        score: &Score,
        exam: &Exam,
        exhibits: &ReportAnswers,
    ) -> Result<(), Error> {
        if score.complete || is_due(self.page_written_at, PAGE_INTERVAL) {
            write(&self.page, &html::page(score, exam, exhibits, self.reload))?;
            self.page_written_at = Some(Instant::now());
        }
        Ok(())
    }
}

fn is_due(written: Option<Instant>, pace: Duration) -> bool {
    written.is_none_or(|at| at.elapsed() >= pace)
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    atomic_write::write(text, path).map_err(|source| Error::Report {
        path: path.to_owned(),
        source,
    })
}
