//! A message that appears if something takes a long time.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

/// A message that is printed to standard error if this value still exists after a given time.
pub(super) struct Notice {
    /// Dropping this ends the waiting thread.
    _ended: Sender<()>,
}

impl Notice {
    pub(super) fn after(time: Duration, message: String) -> Self {
        let (ended, receiver) = channel();
        thread::spawn(move || {
            if receiver.recv_timeout(time) == Err(RecvTimeoutError::Timeout) {
                eprintln!("{message}");
            }
        });
        Notice { _ended: ended }
    }
}
