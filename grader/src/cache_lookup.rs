//! Finds the cached report of an unchanged submission, in a few milliseconds.

use crate::cached_report::{CacheKey, CachedReport};
use crate::cli::Arguments;
use crate::error::Error;
use crate::grade::{builder, collect, default_folder};
use crate::report_files::ReportFiles;
use crate::workspace::Workspace;
use judging::exam_file;

/// Returns the cached report and its files, if the submission was graded before and nothing has
/// changed since.
pub fn find_cached_report(
    arguments: &Arguments,
) -> Result<Option<(CachedReport, ReportFiles)>, Error> {
    if arguments.fresh || !CacheKey::is_cacheable(arguments) {
        return Ok(None);
    }
    let workspace = Workspace::find()?;
    let submission = collect(arguments, &workspace)?;
    let files = ReportFiles::without_reload(&default_folder(&workspace, &submission));
    // The submission is compared first because it changes most often: after an edit, the slower
    // steps below are skipped.
    let cached = CachedReport::read(&files).filter(|cached| cached.is_for(&submission));
    let Some(cached) = cached else {
        return Ok(None);
    };
    let exam = exam_file::hash(arguments.exam.as_deref())?;
    let builder_identity = builder(arguments, &workspace)?.identity();
    let key = CacheKey::new(arguments, &submission, &exam, &builder_identity);
    let is_unchanged = key.is_some_and(|key| cached.is_current(&key, &files));
    Ok(is_unchanged.then_some((cached, files)))
}
