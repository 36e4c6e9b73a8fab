//! Keeps the archive that is about to be replaced if it holds work that the new one does not, as after
//! the assignment was unpacked again over one's own work.

use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::machine::backup;
use crate::machine::files;
use crate::submission::Submission;

/// A former archive that was kept.
#[derive(Debug)]
pub(super) struct FormerArchive {
    /// The path of the copy.
    pub(super) copy: PathBuf,
    /// The task files that it holds work in, while the new ones are missing or as they were handed out.
    pub(super) files: Vec<&'static str>,
}

/// Copies the archive at this path if it holds work in a file that is now missing or as it was handed
/// out. Anything that cannot be read as an archive of the task files is replaced, since it is no work.
pub(super) fn keep_lost_work(
    archive: &Path,
    now: &Submission,
) -> Result<Option<FormerArchive>, Error> {
    let Ok(former) = Submission::collect(archive, now.handed_out) else {
        return Ok(None);
    };
    let pairs = former.files.iter().zip(&now.files);
    let lost = pairs.filter(|((file, before), (_, after))| {
        let had_work = before.as_ref().is_ok_and(|text| !file.is_starter(text));
        let has_work = after.as_ref().is_ok_and(|text| !file.is_starter(text));
        had_work && !has_work
    });
    let files: Vec<&str> = lost.map(|((file, _), _)| file.name).collect();
    if files.is_empty() {
        return Ok(None);
    }
    let copy = backup::keep(archive, &files::read(archive)?)?;
    Ok(Some(FormerArchive { copy, files }))
}
