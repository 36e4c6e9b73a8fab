//! Captures what a process prints, without waiting for the pipe to be closed, because a child of
//! the process may keep it open forever.

use std::io::Read;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// The beginning of the output that a process has printed so far, and the length of that output.
#[derive(Clone, Debug)]
pub struct Capture {
    shared: Arc<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    state: Mutex<State>,
    /// Notified when the pipe is closed, so that waiting for a compiler uses no CPU time.
    end: Condvar,
}

#[derive(Debug, Default)]
struct State {
    head: Vec<u8>,
    total: u64,
    ended: bool,
}

impl Capture {
    /// Starts reading in a thread. Keeps the first `keep` bytes and discards the rest, so that a
    /// process that prints a lot isn't blocked by a full pipe.
    pub fn start(mut pipe: impl Read + Send + 'static, keep: usize) -> Self {
        let capture = Capture {
            shared: Arc::default(),
        };
        let shared = Arc::clone(&capture.shared);
        thread::spawn(move || {
            let mut buffer = vec![0; 1 << 16];
            loop {
                let read = pipe.read(&mut buffer);
                let mut state = shared.lock();
                match read {
                    Ok(0) | Err(_) => {
                        state.ended = true;
                        shared.end.notify_all();
                        return;
                    }
                    Ok(length) => {
                        let kept = keep.saturating_sub(state.head.len()).min(length);
                        state.head.extend_from_slice(&buffer[..kept]);
                        state.total += length as u64;
                    }
                }
            }
        });
        capture
    }

    /// Returns the beginning of the output as text.
    pub fn head(&self) -> String {
        String::from_utf8_lossy(&self.lock().head).into_owned()
    }

    /// Returns the number of bytes that the process has printed so far.
    pub fn total(&self) -> u64 {
        self.lock().total
    }

    /// Waits until the pipe is closed or the timeout expires, whichever comes first.
    pub fn wait_for_end(&self, timeout: Duration) {
        let state = self.lock();
        let waited = self
            .shared
            .end
            .wait_timeout_while(state, timeout, |state| !state.ended);
        drop(waited);
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.shared.lock()
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
