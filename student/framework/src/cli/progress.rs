//! Shows a progress bar while rendering, and a summary afterwards.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use glam::UVec2;
use indicatif::{ProgressBar, ProgressStyle};

use crate::integrator::RenderStats;

/// A progress bar with the remaining time and the rays per second. It is shown only if standard
/// error is a terminal.
pub(super) struct Progress {
    bar: ProgressBar,
    rays: AtomicU64,
    started: Instant,
}

impl Progress {
    /// Creates a bar for this many rows of pixels, each counted once for each sample.
    pub(super) fn new(rows: u64) -> Self {
        let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {eta} left  {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        Progress {
            bar: ProgressBar::new(rows).with_style(style),
            rays: AtomicU64::new(0),
            started: Instant::now(),
        }
    }

    /// Records that one more row has got this many samples.
    pub(super) fn finish_row(&self, stats: RenderStats, samples: u64) {
        let rays = self.rays.fetch_add(stats.rays, Ordering::Relaxed) + stats.rays;
        self.bar.set_message(rate(rays, self.started.elapsed()));
        self.bar.inc(samples);
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
