//! What is written of a score, and where.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::Error;
use crate::exam::Exam;
use crate::exhibit::Exhibits;
use crate::format::outputs::Outputs;
use crate::report::html::{self, Reload};
use crate::report::{json, whole};
use crate::score::Score;

/// While the exam is asked, the page is written no more often than this.
const PAGE_PACE: Duration = Duration::from_secs(1);

/// The files of one submission's score.
#[derive(Debug)]
pub struct Files {
    /// For programs.
    pub score: PathBuf,
    /// For people.
    pub page: PathBuf,
    /// For platforms.
    pub outputs: Outputs,
    /// Where they are, unless a platform says otherwise.
    pub folder: PathBuf,
    page_written: Option<Instant>,
    reload: Reload,
}

impl Files {
    /// Those in this folder.
    pub fn of(folder: &Path, reload: Reload) -> Self {
        Files {
            score: folder.join("score.json"),
            page: folder.join("report.html"),
            outputs: Outputs::default(),
            folder: folder.to_owned(),
            page_written: None,
            reload,
        }
    }

    /// All of them.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        let own = [self.score.as_path(), self.page.as_path()];
        own.into_iter().chain(self.outputs.paths())
    }

    /// Writes both. The page, which takes longer than most items, at the first item and at the
    /// end, and between them after each item that took its time.
    pub fn write(&mut self, score: &Score, exam: &Exam, exhibits: &Exhibits) -> Result<(), Error> {
        write(&self.score, &json::text(score))?;
        let is_fresh = self.page_written.is_some_and(|at| at.elapsed() < PAGE_PACE);
        if score.complete || !is_fresh {
            write(&self.page, &html::page(score, exam, exhibits, self.reload))?;
            self.page_written = Some(Instant::now());
        }
        Ok(())
    }
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    whole::write(text, path).map_err(|source| Error::Report {
        path: path.to_owned(),
        source,
    })
}
