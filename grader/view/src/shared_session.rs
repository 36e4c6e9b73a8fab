//! The session, shared by the threads that compile, draw, record, compose pictures and answer the
//! page's requests.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{io, thread};

use crate::session::{Key, Session};

/// The number of pages that may wait for updates at the same time. A browser opens at most six
/// connections to one server, and it needs the remaining connections for pictures.
const MAX_WAITING: usize = 4;
/// How long a page waits if more than [`MAX_WAITING`] pages are waiting.
const SHORT_WAIT: Duration = Duration::from_millis(500);

/// The session, shared by threads.
#[derive(Debug)]
pub struct SharedSession {
    shared: Mutex<Shared>,
    /// Notified when the session has changed.
    changed: Condvar,
}

#[derive(Debug)]
struct Shared {
    session: Session,
    /// The PNG file of the picture.
    picture: Option<Arc<Vec<u8>>>,
    /// The number of pages that are waiting.
    waiting: usize,
}

impl SharedSession {
    /// Shares a session.
    pub fn new(session: Session) -> Self {
        SharedSession {
            shared: Mutex::new(Shared {
                session,
                picture: None,
                waiting: 0,
            }),
            changed: Condvar::new(),
        }
    }

    /// Starts a thread that shares the session.
    pub fn spawn(
        self: &Arc<Self>,
        name: &str,
        run: impl FnOnce(&SharedSession) + Send + 'static,
    ) -> io::Result<()> {
        let shared = Arc::clone(self);
        let thread = thread::Builder::new().name(name.to_owned());
        thread.spawn(move || run(&shared))?;
        Ok(())
    }

    /// Runs `change` on the session and wakes the threads that wait for work or updates.
    pub fn update<T>(&self, change: impl FnOnce(&mut Session, Instant) -> T) -> T {
        let value = change(&mut self.lock().session, Instant::now());
        self.changed.notify_all();
        value
    }

    /// Runs `read` on the session.
    pub fn read<T>(&self, read: impl FnOnce(&Session, Instant) -> T) -> T {
        read(&self.lock().session, Instant::now())
    }

    /// Waits until `find` returns something from the session, such as a job, and returns it.
    pub fn wait_for<T>(&self, mut find: impl FnMut(&mut Session, Instant) -> Option<T>) -> T {
        let mut shared = self.lock();
        loop {
            if let Some(found) = find(&mut shared.session, Instant::now()) {
                return found;
            }
            let waited = self.changed.wait(shared);
            shared = waited.unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Waits until the session's version differs from `known` or the time is up. Returns whether it
    /// differs. If many pages are waiting, none of them waits long.
    pub fn wait_for_news(&self, known: u64, limit: Duration) -> bool {
        let mut shared = self.lock();
        shared.session.watch(Instant::now());
        shared.waiting += 1;
        let limit = if shared.waiting > MAX_WAITING {
            SHORT_WAIT
        } else {
            limit
        };
        // Drawing may have paused because no page was open.
        self.changed.notify_all();
        let is_known = |shared: &mut Shared| shared.session.shown.version == known;
        let waited = self.changed.wait_timeout_while(shared, limit, is_known);
        let (mut shared, _) = waited.unwrap_or_else(PoisonError::into_inner);
        shared.waiting -= 1;
        shared.session.watch(Instant::now());
        shared.session.shown.version != known
    }

    /// Replaces the picture with one made for this key. `is_complete` says whether it contains all
    /// samples.
    pub fn show_picture(&self, png: Vec<u8>, key: Key, is_complete: bool) {
        let mut shared = self.lock();
        shared.session.show_picture(key, is_complete);
        shared.picture = Some(Arc::new(png));
        self.changed.notify_all();
    }

    /// Returns the PNG file of the picture.
    pub fn picture(&self) -> Option<Arc<Vec<u8>>> {
        self.lock().picture.clone()
    }

    fn lock(&self) -> MutexGuard<'_, Shared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
