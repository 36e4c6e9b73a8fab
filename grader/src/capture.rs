//! Reading what a process prints without ever waiting for its end: a child of it may hold the
//! pipe open for ever.

use std::io::Read;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// What came through a pipe so far: its beginning, and how much there was.
#[derive(Clone, Debug)]
pub struct Capture {
    shared: Arc<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    state: Mutex<State>,
    /// Told when the pipe ends: whoever waits for a compiler uses no time meanwhile.
    end: Condvar,
}

#[derive(Debug, Default)]
struct State {
    head: Vec<u8>,
    total: u64,
    ended: bool,
}

impl Capture {
    /// Starts to read. The first `keep` bytes are kept; all the rest is read and dropped, so that
    /// whoever prints much is not stopped by a full pipe.
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
                        let room = keep.saturating_sub(state.head.len()).min(length);
                        state.head.extend_from_slice(&buffer[..room]);
                        state.total += length as u64;
                    }
                }
            }
        });
        capture
    }

    /// The beginning, as text.
    pub fn head(&self) -> String {
        String::from_utf8_lossy(&self.lock().head).into_owned()
    }

    /// The number of bytes so far.
    pub fn total(&self) -> u64 {
        self.lock().total
    }

    /// Waits until the pipe ends or the time is over, whichever comes first.
    pub fn wait_for_end(&self, patience: Duration) {
        let state = self.lock();
        let waited = self
            .shared
            .end
            .wait_timeout_while(state, patience, |state| !state.ended);
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
