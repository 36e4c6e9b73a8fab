//! Finds the cached report of an unchanged submission, in a few milliseconds.

use crate::cached_report::{CacheKey, CachedReport};
use crate::error::Error;
use crate::grade::{builder, collect, default_folder};
use crate::options::GradeOptions;
use crate::report_files::ReportFiles;
use crate::workspace::Workspace;

/// Returns the cached report and its files, if the submission was graded before and nothing has
/// changed since.
pub fn find_cached_report(
    options: &GradeOptions,
) -> Result<Option<(CachedReport, ReportFiles)>, Error> {
    if !CacheKey::is_cacheable(options) {
        return Ok(None);
    }
    let workspace = Workspace::find()?;
    let submission = collect(options, &workspace)?;
    let files = ReportFiles::without_reload(&default_folder(&workspace, &submission));
    // The submission is compared first because it changes most often: after an edit, the slower
    // steps below are skipped.
    let cached = CachedReport::read(&files).filter(|cached| cached.is_for(&submission));
    let Some(cached) = cached else {
        return Ok(None);
    };
    let exam = options.exam.hash(options.handed_out)?;
    let builder_identity = builder(options, &workspace)?.identity();
    let key = CacheKey::new(options, &submission, &exam, &builder_identity);
    let is_unchanged = key.is_some_and(|key| cached.is_current(&key, &files));
    Ok(is_unchanged.then_some((cached, files)))
}
