//! Grades a submission for a user at a terminal or in a CI job and prints the report.

use std::borrow::Cow;
use std::io::{self, IsTerminal};
use std::process::ExitCode;

use crate::doctor::diagnose;
use crate::error::Error;
use crate::grade::cached_report::{self, CacheKey, CachedReport};
use crate::grade::options::GradeOptions;
use crate::grade::report_files::ReportFiles;
use crate::grade::started::{options_of_each, started_assignments};
use crate::grade::{GradedSubmission, PreparedSubmission, default_folder, grade_prepared};
use crate::machine::desktop;
use crate::machine::printing::{print, print_commands, print_line};
use crate::report::html::Reload;
use crate::report::next_step::{first_step, next_step};
use crate::report::text::report;
use crate::workspace::book::Book;
use crate::workspace::{Workspace, display_path};

/// The notice printed below a cached report.
const UNCHANGED_NOTICE: &str =
    "  Nothing has changed since this was graded; use `--fresh` to grade it again.\n\n";

/// Options for printing a report and for the steps that follow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PrintOptions {
    /// Whether to grade again even if nothing has changed.
    pub fresh: bool,
    /// Whether to open the report's page in a browser.
    pub open: bool,
    /// Whether to print how long each step took.
    pub timings: bool,
    /// Whether to print only one thing to do next.
    pub next: bool,
    /// The number of points below which the exit code is 1.
    pub require: u32,
}

/// Prints a report on each assignment that the submission has started. Returns exit code 1 if the
/// points are below the required number.
pub fn grade_started_and_print(
    options: &GradeOptions,
    print: PrintOptions,
) -> Result<ExitCode, Error> {
    let started = started_assignments(options.submission.as_deref())?;
    let all = options_of_each(options, print.require, &started)?;
    let mut code = ExitCode::SUCCESS;
    for (number, options) in (1..).zip(&all) {
        let points = print_report(options, print, number == all.len())?;
        code = exit_code(points, print.require);
        // `--next` names one thing to do, in the first assignment that isn't complete.
        if print.next && points < options.handed_out.assignment.points() {
            break;
        }
    }
    Ok(code)
}

/// Prints the report on a submission, whether cached or new. Returns exit code 1 if the points are
/// below the required number.
pub fn grade_and_print(options: &GradeOptions, print: PrintOptions) -> Result<ExitCode, Error> {
    let points = print_report(options, print, true)?;
    Ok(exit_code(points, print.require))
}

/// Prints the report on a submission, whether cached or new, and returns the points. If only the next
/// thing to do is printed, nothing is printed about a complete assignment that isn't the last.
fn print_report(options: &GradeOptions, print: PrintOptions, is_last: bool) -> Result<u32, Error> {
    let most = options.handed_out.assignment.points();
    if print.require > most {
        let points = print.require;
        return Err(Error::User(format!(
            "--require {points} cannot be met: the assignment has only {most} points"
        )));
    }
    // A cached report has no timings, and only its text is stored.
    let may_reuse = !print.fresh && !print.timings && !print.next;
    let mut prepared = PreparedSubmission::new(options)?;
    let cached = may_reuse.then(|| find_cached_report(&mut prepared));
    let (points, files) = match cached.transpose()?.flatten() {
        Some((cached, files)) => {
            print_text(
                &prepared,
                &format!("{}{UNCHANGED_NOTICE}{}", cached.report, file_list(&files)),
            );
            (cached.points, Some(files))
        }
        None => grade_and_store(&mut prepared, print, is_last)?,
    };
    if let Some(files) = files.filter(|_| print.open) {
        desktop::show(&files.page);
    }
    Ok(points)
}

fn exit_code(points: u32, required: u32) -> ExitCode {
    if points < required {
        ExitCode::from(1)
    } else {
        ExitCode::SUCCESS
    }
}

/// Returns the cached report and its files if the submission was graded before and nothing has
/// changed since.
fn find_cached_report(
    prepared: &mut PreparedSubmission,
) -> Result<Option<(CachedReport, ReportFiles)>, Error> {
    let options = prepared.options;
    if !CacheKey::is_cacheable(options) {
        return Ok(None);
    }
    let folder = default_folder(&prepared.workspace, &prepared.submission);
    let files = ReportFiles::new(&folder, Reload::Never);
    // Compare the submission first, because it changes most often. After an edit, this skips the
    // slower steps below.
    let cached = CachedReport::read(&files).filter(|cached| cached.is_for(&prepared.submission));
    let Some(cached) = cached else {
        return Ok(None);
    };
    let exam = options.exam.hash(options.handed_out)?;
    let builder_identity = prepared.builder()?.identity();
    let key = CacheKey::new(options, &prepared.submission, &exam, &builder_identity);
    let is_unchanged = key.is_some_and(|key| cached.is_current(&key, &files));
    Ok(is_unchanged.then_some((cached, files)))
}

/// Grades a submission, prints its report and stores it for the next run.
fn grade_and_store(
    prepared: &mut PreparedSubmission,
    print: PrintOptions,
    is_last: bool,
) -> Result<(u32, Option<ReportFiles>), Error> {
    let graded = grade_prepared(prepared)?;
    let text = terminal_report(&graded, prepared.options);
    if print.next {
        let assignment = prepared.options.handed_out.assignment;
        if is_last || graded.score.points < assignment.points() {
            let tasks = &prepared.options.tasks;
            let step = first_step(&graded.score, tasks, assignment, prepared.options.hints);
            print_text(prepared, &step);
        }
    } else {
        let files = graded.files.as_ref().map_or(String::new(), file_list);
        print_text(prepared, &format!("{text}{files}"));
    }
    if let (Some(key), Some(files)) = (&graded.cache_key, &graded.files) {
        cached_report::store(key, &graded.score, &text, files);
    }
    print_commands(&graded.runner_commands());
    if print.timings {
        print_line(graded.score.timings.stages.table());
    }
    Ok((graded.score.points, graded.files))
}

/// Prints the diagnosis of this machine and returns the exit code for it.
pub fn diagnose_and_print() -> Result<ExitCode, Error> {
    let diagnosis = diagnose()?;
    print(&diagnosis);
    Ok(ExitCode::from(diagnosis.exit_code()))
}

/// Returns the report for the terminal. If formats are requested, the report appears in a log that
/// students read, so it only contains what they may see.
fn terminal_report(graded: &GradedSubmission, options: &GradeOptions) -> String {
    let score = if options.formats.is_empty() {
        &graded.score
    } else {
        &graded.student_view.visible
    };
    let mut text = report(score, &options.tasks, options.hints);
    if options.formats.is_empty() {
        let assignment = options.handed_out.assignment;
        text.push_str(&next_step(score, &options.tasks, assignment));
    }
    if options.policy.is_some() && options.tasks.is_all() {
        let counted = graded.student_view.counted.explanation();
        text.push_str(&format!("  {counted}\n\n"));
    }
    text
}

/// Returns the paths of the report's files, one per line.
fn file_list(files: &ReportFiles) -> String {
    let paths = files.paths().map(display_path);
    paths.map(|file| format!("  {file}\n")).collect()
}

/// Prints the text with the full paths of the task files.
fn print_text(prepared: &PreparedSubmission, text: &str) {
    // The full paths aren't cached with the report: the folder may be moved before the report is
    // printed again.
    let text = &*prepared.source_paths().in_text(text);
    print_line(with_links_on_a_terminal(text, &prepared.workspace));
}

/// Returns the text with links to the built handout, if there is one and the reader can click
/// links. The links aren't cached with the report, because it may be printed elsewhere the next
/// time.
fn with_links_on_a_terminal<'a>(text: &'a str, workspace: &Workspace) -> Cow<'a, str> {
    let book = || Book::find(workspace);
    match io::stdout().is_terminal().then(book).flatten() {
        Some(book) => Cow::Owned(book.with_links(text)),
        None => Cow::Borrowed(text),
    }
}
