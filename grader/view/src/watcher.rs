//! The threads that compile: one watches the files and builds the program that draws, the other
//! builds the program that records, when it is wanted.

use std::cell::RefCell;
use std::fs;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use grader::handed_out::RAYS;

use grader::submission::Submission;
use grader::watch::save_watcher::SaveWatcher;

use crate::program::{FileError, Program, Programs};
use crate::session::BuildState;
use crate::studio::Studio;

/// The folders of a submission in which its files usually are.
const USUAL_FOLDERS: [&str; 3] = ["", "src", "student/src"];
/// The time after which the files are read again even if none of them seems to have changed.
const READ_INTERVAL: Duration = Duration::from_secs(1);

/// Reads the submission, but only if the times or sizes of its files have changed, or after a while.
/// Reading takes a millisecond, which is too long for fifty times a second.
struct Reader<'a> {
    programs: &'a Programs,
    last: RefCell<Option<LastRead>>,
}

struct LastRead {
    stamps: Vec<Option<(SystemTime, u64)>>,
    at: Instant,
    submission: Option<Submission>,
}

impl Reader<'_> {
    fn read(&self) -> Option<Submission> {
        let stamps = self.stamps();
        let mut last = self.last.borrow_mut();
        let is_current =
            |last: &&LastRead| last.stamps == stamps && last.at.elapsed() < READ_INTERVAL;
        if let Some(last) = last.as_ref().filter(is_current) {
            return last.submission.clone();
        }
        let submission = self.programs.collect().ok();
        *last = Some(LastRead {
            stamps,
            at: Instant::now(),
            submission: submission.clone(),
        });
        submission
    }

    fn stamps(&self) -> Vec<Option<(SystemTime, u64)>> {
        let stamp = |path| {
            let metadata = fs::metadata(path).ok()?;
            Some((metadata.modified().ok()?, metadata.len()))
        };
        let folders = USUAL_FOLDERS
            .iter()
            .map(|folder| self.programs.folder().join(folder));
        folders
            .flat_map(|folder| RAYS.file_names().map(move |file| folder.join(file)))
            .map(stamp)
            .collect()
    }
}

/// Builds the submission, and again after each save, until the process ends.
fn watch(studio: &Studio, programs: &Programs, first: Submission) {
    let reader = Reader {
        programs,
        last: RefCell::new(None),
    };
    let watcher = SaveWatcher::new(|| reader.read());
    let mut submission = first;
    loop {
        studio.update(|session, _| session.compiling(submission.clone()));
        let report = |errors: Vec<FileError>| {
            // The errors are shown at once. The compiler may find more in other files.
            studio.update(|session, now| session.built(BuildState::Failed(errors), now));
        };
        let state = state(programs.build_drawing(&submission, report));
        studio.update(|session, now| session.built(state, now));
        submission = watcher.wait_for_change(&submission);
    }
}

/// Builds programs that record, whenever one is wanted, until the process ends.
fn build_recordings(studio: &Studio, programs: &Programs) {
    loop {
        let (version, submission) = studio.wait_for_recording_wish();
        let state = state(programs.build_recording(&submission));
        studio.update(|session, _| session.built_recording(state, version));
    }
}

fn state(built: Result<Result<Program, Vec<FileError>>, grader::build::BuildError>) -> BuildState {
    match built {
        Ok(Ok(program)) => BuildState::Ready(program),
        Ok(Err(errors)) => BuildState::Failed(errors),
        Err(error) => BuildState::Broken(error.to_string()),
    }
}

/// Starts the threads.
pub fn start(studio: &Arc<Studio>, programs: &Programs, first: Submission) -> std::io::Result<()> {
    let (shared, of_watcher) = (Arc::clone(studio), programs.clone());
    let thread = thread::Builder::new().name("watcher".to_owned());
    thread.spawn(move || watch(&shared, &of_watcher, first))?;
    let (shared, of_recordings) = (Arc::clone(studio), programs.clone());
    let thread = thread::Builder::new().name("recordings".to_owned());
    thread.spawn(move || build_recordings(&shared, &of_recordings))?;
    Ok(())
}
