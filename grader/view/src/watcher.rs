//! The threads that compile. One watches the files and builds the program that draws. The other
//! builds the program that records, but only when that is needed.

use std::fs;
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use grader::submission::Submission;
use grader::watch::save_watcher::SaveWatcher;

use crate::program::{BuildState, FileError, Programs};
use crate::shared_session::SharedSession;

/// The folders that usually contain a submission's files.
const USUAL_FOLDERS: [&str; 3] = ["", "src", "student/src"];
/// The interval at which the times and sizes of the files are polled.
const POLL_INTERVAL: Duration = Duration::from_millis(20);
/// The time after which the files are read again even if they don't seem to have changed.
const READ_INTERVAL: Duration = Duration::from_secs(1);

/// Detects saves by the files' times and sizes. Reading and comparing the texts takes half a
/// millisecond, which is too slow to do fifty times a second while nothing happens.
struct Stamps<'a> {
    programs: &'a Programs,
    /// The usual folders that contain files of the submission.
    folders: Vec<PathBuf>,
    last: Vec<Option<(SystemTime, u64)>>,
    at: Instant,
}

impl<'a> Stamps<'a> {
    fn new(programs: &'a Programs) -> Self {
        let mut stamps = Stamps {
            programs,
            folders: Vec::new(),
            last: Vec::new(),
            at: Instant::now(),
        };
        stamps.renew();
        stamps
    }

    /// Records the current times and sizes.
    fn renew(&mut self) {
        let all = USUAL_FOLDERS
            .iter()
            .map(|folder| self.programs.folder().join(folder));
        let has_file = |folder: &PathBuf| {
            let mut names = self.programs.handed_out().file_names();
            names.any(|file| folder.join(file).is_file())
        };
        self.folders = all.filter(has_file).collect();
        self.last = self.read();
        self.at = Instant::now();
    }

    /// Waits until a file seems to have changed, but for at most [`READ_INTERVAL`]: a file can be
    /// replaced by one with the same time and size, and archives and other folders aren't checked.
    fn wait(&mut self) {
        while self.at.elapsed() < READ_INTERVAL && self.read() == self.last {
            thread::sleep(POLL_INTERVAL);
        }
        self.renew();
    }

    fn read(&self) -> Vec<Option<(SystemTime, u64)>> {
        let stamp = |path| {
            let metadata = fs::metadata(path).ok()?;
            Some((metadata.modified().ok()?, metadata.len()))
        };
        let handed_out = self.programs.handed_out();
        let folders = self.folders.iter();
        let files =
            folders.flat_map(|folder| handed_out.file_names().map(|file| folder.join(file)));
        files.map(stamp).collect()
    }
}

/// Builds the submission and rebuilds it after each save, until the process ends.
pub fn watch(shared: &SharedSession, programs: &Programs, first: Submission) {
    let watcher = SaveWatcher::new(|| programs.collect().ok());
    let mut stamps = Stamps::new(programs);
    let mut submission = first;
    loop {
        shared.update(|session, _| session.compiling(submission.clone()));
        let report = |errors: Vec<FileError>| {
            // Show the errors immediately. The compiler may find more in other files.
            shared.update(|session, now| session.built(BuildState::Failed(errors), now));
        };
        let state = programs.build(&submission, report);
        shared.update(|session, now| session.built(state, now));
        // A file may have been saved since it was read.
        while !watcher.has_changed_since(&submission) {
            stamps.wait();
        }
        submission = watcher.wait_for_change(&submission);
    }
}

/// Builds the recording program whenever it is needed, until the process ends.
pub fn build_recordings(shared: &SharedSession, programs: &Programs) {
    loop {
        let (version, submission) = shared.wait_for(|session, _| session.wanted_recording());
        let state = programs.build_recording(&submission);
        shared.update(|session, _| session.built_recording(state, version));
    }
}
