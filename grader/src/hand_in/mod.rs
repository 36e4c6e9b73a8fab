//! Makes the archive that a student hands in and checks it by reading it the way the grader will.

mod archive;
mod summary;

use std::path::{Path, PathBuf};

use clap::Parser;

use crate::build::Builder;
use crate::error::Error;
use crate::grade::options::GradeOptions;
use crate::grade::{PreparedSubmission, build_report};
use crate::handed_out::{ASSIGNMENTS, HandedOut, is_unwritten};
use crate::machine::backup;
use crate::machine::files;
use crate::report::atomic_write;
use crate::score::BuildReport;
use crate::submission::Submission;
use crate::workspace::Workspace;

pub use archive::archive_bytes;

/// Returns the name of the archive, which is written to the workspace's root by default.
fn archive_name(handed_out: &'static HandedOut) -> String {
    if handed_out == <&HandedOut>::default() {
        "handin.zip".to_owned()
    } else {
        format!("handin-{}.zip", handed_out.assignment.id)
    }
}

/// Packs the archive to hand in, checks it the way the grader will, and lists its contents
///
/// Exit codes: 0 packed; 1 packed, but a file does not compile, or nothing has been written yet;
/// 2 invalid command line or folder; 3 the machine failed.
#[derive(Clone, Debug, Default, Parser)]
#[command(name = "cargo handin", bin_name = "cargo handin", version)]
pub struct HandInArguments {
    /// The folder with the task files; default: student
    pub folder: Option<PathBuf>,

    /// The archive to write; default: handin.zip in the project's folder, or handin-ID.zip for
    /// an assignment other than the default
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// The assignment; default: rays
    #[arg(long, value_name = "ID", value_parser = HandedOut::find, hide = ASSIGNMENTS.len() == 1)]
    pub assignment: Option<&'static HandedOut>,
}

/// An archive that has been made and checked.
#[derive(Debug)]
pub struct HandIn {
    /// The path of the archive.
    pub archive: PathBuf,
    /// The submission read back from the archive.
    submission: Submission,
    /// The task files in the folder. Some may be missing or unreadable.
    original: Submission,
    /// The compiler's errors and notes about files.
    build: BuildReport,
    /// The previous archive, if it contains work that the new one doesn't.
    kept: Option<PreviousArchive>,
}

impl HandIn {
    /// Makes an archive from a student's own work or from another folder, reads it back and
    /// compiles its contents.
    pub fn make(arguments: HandInArguments) -> Result<Self, Error> {
        let handed_out = arguments.assignment.unwrap_or_default();
        let folder = arguments.folder;
        if let Some(folder) = &folder
            && Workspace::find()?.resolve(folder).is_file()
        {
            return Err(Error::User(format!(
                "{} is a file: pass the folder that contains the task files, such as `student`",
                folder.display()
            )));
        }
        let options = GradeOptions {
            handed_out,
            submission: folder,
            ..GradeOptions::default()
        };
        let PreparedSubmission {
            workspace,
            submission: original,
            ..
        } = PreparedSubmission::new(&options)?;
        let archive = match arguments.out {
            Some(path) => path,
            None => workspace.root().join(archive_name(handed_out)),
        };
        if original.files.iter().all(|(_, text)| text.is_err()) {
            return Err(Error::User(format!(
                "no task file in {} can be read: run `cargo grade` to see why",
                original.name
            )));
        }
        let bytes = archive_bytes(&original)
            .map_err(|error| Error::Machine(format!("cannot create the archive: {error}")))?;
        let kept = keep_lost_work(&archive, &original)?;
        atomic_write::write(&bytes, &archive)?;

        let submission = read_back(&archive, &original, &bytes)?;
        let build = Builder::prepare(&workspace)?.build(&submission)?;
        Ok(HandIn {
            build: build_report(&original, &build),
            archive,
            submission,
            original,
            kept,
        })
    }

    /// Returns whether at least one task has been started and everything compiles.
    pub fn is_ready(&self) -> bool {
        self.is_started() && self.build.not_compiled.is_empty()
    }

    /// Returns whether any file differs from the version that was handed out.
    fn is_started(&self) -> bool {
        let mut files = self.original.files.iter();
        files.any(|(file, text)| text.as_ref().is_ok_and(|text| !is_unwritten(file, text)))
    }
}

/// A copy of the previous archive.
#[derive(Debug)]
struct PreviousArchive {
    /// The path of the copy.
    copy: PathBuf,
    /// The task files that contain work in the old archive but are missing or unmodified in the new
    /// one.
    files: Vec<&'static str>,
}

/// Copies the archive at this path if it contains work in a file that is now missing or unmodified.
/// Anything that cannot be read as an archive of the task files is simply replaced, since it
/// doesn't contain work.
fn keep_lost_work(archive: &Path, now: &Submission) -> Result<Option<PreviousArchive>, Error> {
    let Ok(former) = Submission::collect(archive, now.handed_out) else {
        return Ok(None);
    };
    let pairs = former.files.iter().zip(&now.files);
    let lost = pairs.filter(|((file, before), (_, after))| {
        let had_work = before.as_ref().is_ok_and(|text| !is_unwritten(file, text));
        let has_work = after.as_ref().is_ok_and(|text| !is_unwritten(file, text));
        had_work && !has_work
    });
    let files: Vec<&str> = lost.map(|((file, _), _)| file.name).collect();
    if files.is_empty() {
        return Ok(None);
    }
    let copy = backup::keep(archive, &files::read(archive)?)?;
    Ok(Some(PreviousArchive { copy, files }))
}

/// Reads the archive the way the grader will and compares it with the original.
fn read_back(archive: &Path, original: &Submission, bytes: &[u8]) -> Result<Submission, Error> {
    let changed = || {
        Error::Machine(format!(
            "{} changed while it was being checked, or the disk is damaged: run `cargo handin` again",
            archive.display()
        ))
    };
    if files::read(archive)? != bytes {
        return Err(changed());
    }
    let submission = Submission::collect(archive, original.handed_out)?;
    let mut pairs = submission.files.iter().zip(&original.files);
    if pairs.all(|((_, read), (_, written))| read.as_ref().ok() == written.as_ref().ok()) {
        Ok(submission)
    } else {
        Err(changed())
    }
}
