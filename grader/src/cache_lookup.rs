//! A submission that is graded again as it was: what was said of it then, in a few milliseconds.

use crate::cached_report::{CacheKey, CachedReport};
use crate::cli::Arguments;
use crate::error::Error;
use crate::exam_file;
use crate::grade::{builder, collect, default_folder};
use crate::report_files::ReportFiles;
use crate::workspace::Workspace;

/// What was said of the submission, and the files that tell it, if it was graded before, and nothing
/// has changed since.
pub fn find_cached_report(
    arguments: &Arguments,
) -> Result<Option<(CachedReport, ReportFiles)>, Error> {
    if arguments.fresh || !CacheKey::is_cacheable(arguments) {
        return Ok(None);
    }
    let workspace = Workspace::find()?;
    let submission = collect(arguments, &workspace)?;
    let files = ReportFiles::without_reload(&default_folder(&workspace, &submission));
    // What mostly changes comes first: whoever has edited a file waits for no more than this.
    let earlier = CachedReport::read(&files).filter(|earlier| earlier.is_for(&submission));
    let Some(earlier) = earlier else {
        return Ok(None);
    };
    let exam = exam_file::hash(arguments.exam.as_deref())?;
    let built_with = builder(arguments, &workspace)?.identity();
    let key = CacheKey::new(arguments, &submission, &exam, &built_with);
    let is_unchanged = key.is_some_and(|key| earlier.is_current(&key, &files));
    Ok(is_unchanged.then_some((earlier, files)))
}
