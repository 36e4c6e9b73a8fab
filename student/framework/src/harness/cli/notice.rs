//! A message that appears if something takes long.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

/// A message that is printed to standard error if this value still exists after some time.
pub(super) struct Notice {
    /// Dropping it ends the thread that waits.
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
