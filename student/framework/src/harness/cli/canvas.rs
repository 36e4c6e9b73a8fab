//! A picture that is rendered in passes, so that you can look at it before it is finished.

use std::path::Path;
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

use glam::{UVec2, Vec3};

use super::image_file;
use crate::render::film::{Film, Tone};

/// How often the unfinished picture is written.
const INTERVAL: Duration = Duration::from_secs(1);
/// The conventional exit code of a program ended by Ctrl-C.
pub(super) const INTERRUPTED: i32 = 130;

/// Events for the thread that writes the unfinished picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Event {
    /// Ctrl-C was pressed.
    Interrupted,
    /// The picture is finished.
    Finished,
}

/// The sums of the samples so far.
pub(super) struct Canvas {
    size: UVec2,
    rows: Vec<Mutex<Row>>,
}

/// A row of pixels. Rows can have different numbers of samples.
#[derive(Clone)]
pub(super) struct Row {
    pub(super) sums: Vec<Vec3>,
    pub(super) samples: u32,
}

impl Canvas {
    pub(super) fn new(size: UVec2) -> Self {
        let row = Row {
            sums: vec![Vec3::ZERO; size.x as usize],
            samples: 0,
        };
        let rows = (0..size.y).map(|_| Mutex::new(row.clone())).collect();
        Canvas { size, rows }
    }

    /// Returns a copy of a row.
    pub(super) fn row(&self, y: u32) -> Row {
        self.lock(y).clone()
    }

    /// Replaces a row.
    pub(super) fn set_row(&self, y: u32, row: Row) {
        *self.lock(y) = row;
    }

    fn lock(&self, y: u32) -> std::sync::MutexGuard<'_, Row> {
        let row = self.rows[y as usize].lock();
        row.unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Returns the picture so far and the minimum number of samples per pixel.
    pub(super) fn film(&self) -> (Film, u32) {
        let rows: Vec<Row> = (0..self.size.y).map(|y| self.row(y)).collect();
        let samples = rows.iter().map(|row| row.samples).min().unwrap_or(0);
        let mean = |row: &Row| {
            let count = row.samples.max(1) as f32;
            let means = row.sums.iter().map(|sum| *sum / count);
            means.collect::<Vec<Vec3>>()
        };
        let pixels = rows.iter().flat_map(mean).collect();
        let film = Film {
            size: self.size,
            pixels,
        };
        (film, samples)
    }

    /// Writes the unfinished picture every second until it is finished. After Ctrl-C, writes the
    /// current state and ends the process, even if the submission hangs.
    pub(super) fn write_until_finished(
        &self,
        events: &Receiver<Event>,
        tone: Tone,
        path: &Path,
        total: u32,
    ) {
        loop {
            match events.recv_timeout(INTERVAL) {
                // Errors are reported when the finished picture is written.
                Err(RecvTimeoutError::Timeout) => {
                    drop(image_file::write(&self.film().0, tone, path))
                }
                Ok(Event::Interrupted) => {
                    let (film, samples) = self.film();
                    match image_file::write(&film, tone, path) {
                        Ok(()) => eprintln!("{}", self.stopped(path, samples, total)),
                        Err(error) => eprintln!("{error}"),
                    }
                    std::process::exit(INTERRUPTED);
                }
                Ok(Event::Finished) | Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    fn stopped(&self, path: &Path, samples: u32, total: u32) -> String {
        let path = path.display();
        if samples == 0 {
            let done = (0..self.size.y)
                .filter(|y| self.lock(*y).samples > 0)
                .count();
            let rows = self.size.y;
            return format!("{path}: stopped after {done} of {rows} rows of pixels");
        }
        format!("{path}: stopped after {samples} of {total} samples per pixel")
    }
}

/// Returns the passes over the picture as ranges of samples. Each pass doubles the number of
/// samples.
pub(super) fn passes(samples: u32) -> impl Iterator<Item = std::ops::Range<u32>> {
    let next = move |start: &u32| Some((2 * start).max(1).min(samples)).filter(|end| end > start);
    let starts = std::iter::successors(Some(0), next);
    starts.filter_map(move |start| Some(start..next(&start)?))
}

#[cfg(test)]
mod tests {
    use glam::uvec2;

    use super::*;

    #[test]
    fn passes_cover_all_samples_once() {
        for samples in [0, 1, 2, 3, 7, 8, 32, 100] {
            let all: Vec<u32> = passes(samples).flatten().collect();
            assert_eq!(all, (0..samples).collect::<Vec<_>>());
        }
        assert_eq!(passes(6).collect::<Vec<_>>(), [0..1, 1..2, 2..4, 4..6]);
    }

    #[test]
    fn the_unfinished_picture_is_the_mean_of_the_samples_so_far() {
        let canvas = Canvas::new(uvec2(1, 2));
        let row = Row {
            sums: vec![Vec3::splat(6.0)],
            samples: 3,
        };
        canvas.set_row(1, row);
        let (film, samples) = canvas.film();
        assert_eq!(film.pixels, [Vec3::ZERO, Vec3::splat(2.0)]);
        assert_eq!(samples, 0);
        let stopped = canvas.stopped(Path::new("a.png"), samples, 8);
        assert_eq!(stopped, "a.png: stopped after 1 of 2 rows of pixels");
        assert_eq!(
            canvas.stopped(Path::new("a.png"), 3, 8),
            "a.png: stopped after 3 of 8 samples per pixel"
        );
    }
}
