//! A submission that is graded again as it was: what was said of it then, in a few milliseconds.

use crate::cli::Arguments;
use crate::earlier::{Earlier, Key};
use crate::error::Error;
use crate::exam_file;
use crate::files::Files;
use crate::grade::{builder, collect, usual_folder};
use crate::workspace::Workspace;

/// What was said of the submission, and the files that tell it, if it was graded before, and nothing
/// has changed since.
pub fn find(arguments: &Arguments) -> Result<Option<(Earlier, Files)>, Error> {
    if arguments.fresh || !Key::is_kept(arguments) {
        return Ok(None);
    }
    let workspace = Workspace::find()?;
    let submission = collect(arguments, &workspace)?;
    let files = Files::usual(&usual_folder(&workspace, &submission));
    // What mostly changes comes first: whoever has edited a file waits for no more than this.
    let earlier = Earlier::read(&files).filter(|earlier| earlier.is_of(&submission));
    let Some(earlier) = earlier else {
        return Ok(None);
    };
    let exam = exam_file::hash(arguments.exam.as_deref())?;
    let built_with = builder(arguments, &workspace)?.identity();
    let key = Key::of(arguments, &submission, &exam, &built_with);
    let is_unchanged = key.is_some_and(|key| earlier.holds(&key, &files));
    Ok(is_unchanged.then_some((earlier, files)))
}
