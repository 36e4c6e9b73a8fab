//! The main job, from a command line to a score.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::ask::Budget;
use crate::build::{Build, BuildError, Builder};
use crate::cli::Arguments;
use crate::error::Error;
use crate::exam::Exam;
use crate::exam_file;
use crate::examine::examine;
use crate::exhibit::Exhibits;
use crate::report;
use crate::score::{BuildReport, FileReport, Score};
use crate::submission::Submission;
use crate::verdict::{file_message, unasked};
use crate::workspace::Workspace;

/// While the exam is asked, the page is written no more often than this.
const PAGE_PACE: Duration = Duration::from_secs(1);

/// A submission's score, and where it was written, if it was.
#[derive(Debug)]
pub struct Graded {
    /// The score.
    pub score: Score,
    /// The score file.
    pub file: Option<PathBuf>,
    /// The page beside it.
    pub page: Option<PathBuf>,
}

/// Loads the exam, collects the submission, builds it, asks, judges, scores.
pub fn grade(arguments: &Arguments) -> Result<Graded, Error> {
    let workspace = Workspace::find()?;
    let exam = exam_file::load(arguments.exam.as_deref())?;
    let submission = collect(arguments, &workspace)?;

    let began = Instant::now();
    let build = builder(arguments, &workspace)?.build(&submission)?;
    let built = Instant::now();

    let asked = match arguments.task {
        Some(task) => exam.exam.with_what_it_needs(task),
        None => exam.exam.clone(),
    };
    let mut score = unasked(&asked, exam.name(), &submission.name);
    score.build = build_report(&submission, &build);
    score.timings.build_ms = millis(built - began);
    // One task's points are no score.
    let mut files = arguments
        .task
        .is_none()
        .then(|| Files::in_folder(&folder(arguments, &workspace, &submission)));
    examine(
        &asked,
        &build,
        budget(arguments),
        &mut score,
        |score, exhibits| {
            let mut score = score.clone();
            score.timings.exam_ms = millis(built.elapsed());
            match &mut files {
                Some(files) => files.write(&score, &asked, exhibits),
                None => Ok(()),
            }
        },
    )?;
    score.timings.exam_ms = millis(built.elapsed());
    let (file, page) = files.map(|files| (files.score, files.page)).unzip();
    Ok(Graded { score, file, page })
}

/// What is written of a score, and where.
struct Files {
    score: PathBuf,
    page: PathBuf,
    page_written: Option<Instant>,
}

impl Files {
    fn in_folder(folder: &Path) -> Self {
        Files {
            score: folder.join("score.json"),
            page: folder.join("report.html"),
            page_written: None,
        }
    }

    /// Writes both. The page, which takes longer than most items, at the first item and at the
    /// end, and between them after each item that took its time.
    fn write(&mut self, score: &Score, exam: &Exam, exhibits: &Exhibits) -> Result<(), Error> {
        write(&self.score, &report::json::text(score))?;
        let is_fresh = self.page_written.is_some_and(|at| at.elapsed() < PAGE_PACE);
        if score.complete || !is_fresh {
            write(&self.page, &report::html::page(score, exam, exhibits))?;
            self.page_written = Some(Instant::now());
        }
        Ok(())
    }
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    report::whole::write(text, path).map_err(|source| Error::Report {
        path: path.to_owned(),
        source,
    })
}

/// What submissions are built with: with the reference, where it is at hand and not declined.
fn builder(arguments: &Arguments, workspace: &Workspace) -> Result<Builder, BuildError> {
    let builder = Builder::prepare(workspace)?;
    match workspace.reference() {
        Some(reference) if !arguments.no_reference => builder.with_reference(&reference, workspace),
        Some(_) | None => Ok(builder),
    }
}

/// The submission that the command line names.
pub fn collect(arguments: &Arguments, workspace: &Workspace) -> Result<Submission, Error> {
    let folder = match &arguments.submission {
        Some(path) => workspace.resolve(path),
        None => workspace.student(),
    };
    Ok(Submission::collect(&folder)?)
}

/// What an item may use.
pub fn budget(arguments: &Arguments) -> Budget {
    Budget {
        cpu: Duration::from_secs(arguments.cpu_limit),
    }
}

fn folder(arguments: &Arguments, workspace: &Workspace, submission: &Submission) -> PathBuf {
    match &arguments.out {
        Some(folder) => folder.clone(),
        None => workspace.grade().join(&submission.name),
    }
}

fn build_report(submission: &Submission, build: &Build) -> BuildReport {
    let not_compiled = build.not_compiled.iter().map(|(file, why)| FileReport {
        file: (*file).to_owned(),
        message: file_message(file, why),
    });
    BuildReport {
        not_compiled: not_compiled.collect(),
        notes: notes(submission, build),
    }
}

/// What is worth knowing of a submission's files and costs nothing.
fn notes(submission: &Submission, build: &Build) -> Vec<String> {
    let mut notes = submission.notes.clone();
    let compiled = submission
        .files
        .iter()
        .filter(|(file, _)| !build.not_compiled.contains_key(file.name));
    for (file, text) in compiled {
        let changed = text.as_ref().map_or(Vec::new(), |text| file.changed(text));
        if !changed.is_empty() {
            let (file, changed) = (file.name, changed.join(", "));
            notes.push(format!(
                "{file}: given methods were changed, at no cost by itself: {changed}"
            ));
        }
    }
    notes
}

fn millis(duration: Duration) -> u64 {
    u64::try_from(duration.as_millis()).unwrap_or(u64::MAX)
}
