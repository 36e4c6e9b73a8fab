//! Finds the cached report of an unchanged submission, in a few milliseconds.

use crate::cached_report::{CacheKey, CachedReport};
use crate::error::Error;
use crate::grade::{Prepared, default_folder};
use crate::report_files::ReportFiles;

/// Returns the cached report and its files, if the submission was graded before and nothing has
/// changed since.
pub fn find_cached_report(
    prepared: &mut Prepared,
) -> Result<Option<(CachedReport, ReportFiles)>, Error> {
    let options = prepared.options;
    if !CacheKey::is_cacheable(options) {
        return Ok(None);
    }
    let folder = default_folder(&prepared.workspace, &prepared.submission);
    let files = ReportFiles::without_reload(&folder);
    // The submission is compared first because it changes most often: after an edit, the slower
    // steps below are skipped.
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
