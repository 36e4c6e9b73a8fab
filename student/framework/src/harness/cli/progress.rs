//! Shows a progress bar during rendering, a summary afterwards, and a message if something takes a
//! long time.

use std::path::Path;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use glam::UVec2;
use indicatif::{ProgressBar, ProgressStyle};

use crate::render::renderer::RenderStats;

/// How long to wait, if there is no progress bar, before printing that rendering is still running.
const LONG: Duration = Duration::from_secs(10);

/// A progress bar with the remaining time and the rays per second. It is only shown if standard
/// error is a terminal.
pub(super) struct Progress {
    bar: ProgressBar,
    stats: Mutex<RenderStats>,
    started: Instant,
    /// If there is no bar, says that rendering is still running.
    _notice: Option<Notice>,
}

impl Progress {
    /// Creates a bar for this many rows of pixels, each counted once per sample. `note` is added to
    /// the message that is shown if there is no bar.
    pub(super) fn new(rows: u64, note: &str) -> Self {
        let style = ProgressStyle::with_template("{bar:30} {percent:>3}%  {eta} left  {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::new(rows).with_style(style);
        let message = format!("rendering: still running{note}");
        Progress {
            _notice: bar.is_hidden().then(|| Notice::after(LONG, message)),
            bar,
            stats: Mutex::default(),
            started: Instant::now(),
        }
    }

    /// Records that this many samples have been added to one more row.
    pub(super) fn finish_row(&self, stats: RenderStats, samples: u64) {
        let mut all = self.lock();
        all.add(&stats);
        let rays = all.rays;
        drop(all);
        self.bar.set_message(rate(rays, self.started.elapsed()));
        self.bar.inc(samples);
    }

    /// Returns the statistics for all rows finished so far.
    pub(super) fn stats(&self) -> RenderStats {
        *self.lock()
    }

    fn lock(&self) -> MutexGuard<'_, RenderStats> {
        self.stats.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Returns the line that is printed after rendering.
pub(super) fn summary(path: &Path, size: UVec2, stats: RenderStats, time: Duration) -> String {
    format!(
        "{}: {} x {}, {:.1} s, {:.1} Mrays, {}",
        path.display(),
        size.x,
        size.y,
        time.as_secs_f64(),
        stats.rays as f64 * 1e-6,
        rate(stats.rays, time),
    )
}

fn rate(rays: u64, time: Duration) -> String {
    let seconds = time.as_secs_f64().max(1e-9);
    format!("{:.2} Mrays/s", rays as f64 * 1e-6 / seconds)
}

/// A message that is printed to standard error if this value still exists after a certain time.
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
