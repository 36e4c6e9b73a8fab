//! Detects when a submission has been saved, by polling its task files.
//!
//! File system events would be a few milliseconds faster, but they aren't always delivered on
//! network drives, in containers and in virtual machines. Reading a few small files takes 50 µs.

use std::thread;
use std::time::Duration;

use crate::submission::Submission;

/// Time between two reads of the files.
pub const POLL_INTERVAL: Duration = Duration::from_millis(20);

/// Watches files that may be saved at any time, such as a submission.
pub struct SaveWatcher<'a, Files = Submission> {
    collect: Box<dyn Fn() -> Option<Files> + 'a>,
    pause: Box<dyn Fn() + 'a>,
}

impl<'a, Files: PartialEq> SaveWatcher<'a, Files> {
    /// Creates a watcher for the files that `collect` reads. `collect` returns `None` while there are
    /// none.
    pub fn new(collect: impl Fn() -> Option<Files> + 'a) -> Self {
        SaveWatcher {
            collect: Box::new(collect),
            pause: Box::new(|| thread::sleep(POLL_INTERVAL)),
        }
    }

    /// Returns whether the files now differ from `last`.
    pub fn has_changed_since(&self, last: &Files) -> bool {
        (self.collect)().is_some_and(|now| now != *last)
    }

    /// Waits for the next version and returns it. Two reads in a row must give the same version,
    /// because editors write a file in several steps and some delete it first.
    pub fn wait_for_change(&self, last: &Files) -> Files {
        self.wait_for_change_while(last, || ())
    }

    /// Waits for the next version. Calls `meanwhile` between reads.
    pub fn wait_for_change_while(&self, last: &Files, meanwhile: impl FnMut()) -> Files {
        self.wait_for(|now| now != last, meanwhile)
    }

    /// Waits until two reads in a row give the same version, even if it isn't a new one.
    pub fn wait_for_version(&self) -> Files {
        self.wait_for(|_| true, || ())
    }

    fn wait_for(&self, is_wanted: impl Fn(&Files) -> bool, mut meanwhile: impl FnMut()) -> Files {
        let mut before = None;
        loop {
            let now = (self.collect)().filter(&is_wanted);
            match now {
                Some(now) if before.as_ref() == Some(&now) => return now,
                now => before = now,
            }
            meanwhile();
            (self.pause)();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::handed_out::RAYS;

    fn version(text: &str) -> Option<Submission> {
        Some(Submission {
            handed_out: &RAYS,
            name: "student".to_owned(),
            files: vec![(RAYS.files[0], Ok(text.to_owned()))],
            ignored_copies: Vec::new(),
            notes: Vec::new(),
        })
    }

    /// Returns a watcher that reads these versions one after another.
    fn watcher_reading(reads: Vec<Option<Submission>>) -> SaveWatcher<'static> {
        let reads = RefCell::new(reads.into_iter());
        SaveWatcher {
            collect: Box::new(move || reads.borrow_mut().next().expect("it does not read again")),
            pause: Box::new(|| {}),
        }
    }

    #[test]
    fn waits_until_two_reads_agree() {
        let reads = ["old", "old", "", "half", "whole", "whole"];
        let watcher = watcher_reading(reads.map(version).to_vec());
        let next = watcher.wait_for_change(&version("old").unwrap());
        assert_eq!(Some(next), version("whole"));
    }

    #[test]
    fn does_something_else_between_two_reads() {
        let watcher = watcher_reading(["old", "new", "new"].map(version).to_vec());
        let mut calls = 0;
        watcher.wait_for_change_while(&version("old").unwrap(), || calls += 1);
        assert_eq!(calls, 2);
    }

    #[test]
    fn a_version_may_be_the_last_one_again() {
        let watcher = watcher_reading(["half", "old", "old"].map(version).to_vec());
        assert_eq!(Some(watcher.wait_for_version()), version("old"));
    }

    #[test]
    fn waits_for_a_missing_folder_to_return() {
        let watcher = watcher_reading(vec![version("new"), None, version("new"), version("new")]);
        let next = watcher.wait_for_change(&version("old").unwrap());
        assert_eq!(Some(next), version("new"));
    }
}
