//! The threads that compile. One watches the files and builds the program that draws. The other
//! builds the program that records, but only when that is needed.

use std::fs;
use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use grader::watch::save_watcher::SaveWatcher;

use crate::program::{BuildState, FileError, Files, Programs};
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
    /// The files in the usual folders.
    files: Vec<PathBuf>,
    last: Vec<Option<(SystemTime, u64)>>,
    at: Instant,
}

impl<'a> Stamps<'a> {
    fn new(programs: &'a Programs) -> Self {
        let mut stamps = Stamps {
            programs,
            files: Vec::new(),
            last: Vec::new(),
            at: Instant::now(),
        };
        stamps.renew();
        stamps
    }

    /// Records the current times and sizes.
    fn renew(&mut self) {
        self.files = Vec::new();
        for (handed_out, path) in self.programs.sources() {
            for folder in USUAL_FOLDERS.map(|folder| path.join(folder)) {
                let files = handed_out.file_names().map(|file| folder.join(file));
                let files: Vec<PathBuf> = files.collect();
                if files.iter().any(|file| file.is_file()) {
                    self.files.extend(files);
                }
            }
        }
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
        let stamp = |path: &PathBuf| {
            let metadata = fs::metadata(path).ok()?;
            Some((metadata.modified().ok()?, metadata.len()))
        };
        self.files.iter().map(stamp).collect()
    }
}

/// Builds the program that draws and rebuilds it after each save, until the process ends.
pub fn watch(shared: &SharedSession, programs: &Programs, first: Files) {
    let watcher = SaveWatcher::new(|| programs.collect().ok());
    let mut stamps = Stamps::new(programs);
    let mut files = first;
    loop {
        shared.update(|session, _| session.compiling(files.clone()));
        let report = |errors: Vec<FileError>| {
            // Show the errors immediately. The compiler may find more in other files.
            shared.update(|session, now| session.built(BuildState::Failed(errors), now));
        };
        let state = programs.build(&files, report);
        shared.update(|session, now| session.built(state, now));
        // A file may have been saved since it was read.
        while !watcher.has_changed_since(&files) {
            stamps.wait();
        }
        files = watcher.wait_for_change(&files);
    }
}

/// Builds the recording program whenever it is needed, until the process ends.
pub fn build_recordings(shared: &SharedSession, programs: &Programs) {
    loop {
        let (version, files) = shared.wait_for(|session, _| session.wanted_recording());
        let state = programs.build_recording(&files);
        shared.update(|session, _| session.built_recording(state, version));
    }
}
