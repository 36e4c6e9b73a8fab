//! When a submission has been saved: by reading its five files again and again.
//!
//! Events of the file system would come sooner by some milliseconds, and not at all on network
//! drives, in containers and in virtual machines. Five small files are read in 50 µs.

use std::thread;
use std::time::Duration;

use crate::submission::Submission;

/// How often is looked.
const POLL_INTERVAL: Duration = Duration::from_millis(20);

/// A submission that may be saved at any time.
pub struct SaveWatcher<'a> {
    collect: Box<dyn Fn() -> Option<Submission> + 'a>,
    pause: Box<dyn Fn() + 'a>,
}

impl<'a> SaveWatcher<'a> {
    /// Of what `collect` reads; while it is nowhere, that is nothing.
    pub fn new(collect: impl Fn() -> Option<Submission> + 'a) -> Self {
        SaveWatcher {
            collect: Box::new(collect),
            pause: Box::new(|| thread::sleep(POLL_INTERVAL)),
        }
    }

    /// Whether the submission is another one by now.
    pub fn has_changed_since(&self, last: &Submission) -> bool {
        (self.collect)().is_some_and(|now| now != *last)
    }

    /// Waits for the next version: one that is seen twice in a row, because editors write a file
    /// in several steps, and many a one takes it away before.
    pub fn wait_for_change(&self, last: &Submission) -> Submission {
        let mut before = None;
        loop {
            let now = (self.collect)().filter(|now| now != last);
            match now {
                Some(now) if before.as_ref() == Some(&now) => return now,
                now => before = now,
            }
            (self.pause)();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::given_files::TASK_FILES;

    fn version(text: &str) -> Option<Submission> {
        Some(Submission {
            name: "student".to_owned(),
            files: vec![(TASK_FILES[0], Ok(text.to_owned()))],
            notes: Vec::new(),
        })
    }

    /// What is read, look after look.
    fn watcher_reading(looks: Vec<Option<Submission>>) -> SaveWatcher<'static> {
        let looks = RefCell::new(looks.into_iter());
        SaveWatcher {
            collect: Box::new(move || looks.borrow_mut().next().expect("it need not look on")),
            pause: Box::new(|| {}),
        }
    }

    #[test]
    fn waits_until_two_reads_agree() {
        let looks = ["old", "old", "", "half", "whole", "whole"];
        let saves = watcher_reading(looks.map(version).to_vec());
        assert_eq!(
            Some(saves.wait_for_change(&version("old").unwrap())),
            version("whole")
        );
    }

    #[test]
    fn waits_for_a_missing_folder_to_return() {
        let saves = watcher_reading(vec![version("new"), None, version("new"), version("new")]);
        assert_eq!(
            Some(saves.wait_for_change(&version("old").unwrap())),
            version("new")
        );
    }
}
