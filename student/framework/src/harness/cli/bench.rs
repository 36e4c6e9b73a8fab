//! `--bench`: measures how many rays per second the submission traces, and compares it with the
//! last measurement.

use std::fmt::Write;
use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use super::Job;
use super::error::RenderError;
use super::progress::Progress;
use crate::render::renderer::{RenderStats, Renderer};

/// The number of runs of each kind. Other programs can only slow a run down, so the fastest run is
/// used.
const RUNS: usize = 7;

/// The result of a measurement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measurement {
    /// The number of rays in one run.
    rays: u64,
    /// How long the fastest run took.
    time: Duration,
    /// The share of the time that is spent in `Bvh::hit` and the methods it calls.
    share_in_hit: f64,
}

/// Traces one path per pixel in each run. Runs that time only the whole picture alternate with
/// slower runs that also time each call to `Bvh::hit`.
pub(super) fn measure(job: &Job, renderer: &dyn Renderer) -> Result<Measurement, RenderError> {
    let mut best = Measurement {
        rays: 0,
        time: Duration::MAX,
        share_in_hit: 0.0,
    };
    let mut shortest = Duration::MAX;
    for _ in 0..RUNS {
        let progress = Progress::new(u64::from(job.pool.size().y), "");
        let started = Instant::now();
        job.pool.render(&progress, |pixel, stats| {
            black_box(renderer.sample_radiance(pixel, 0, stats));
        })?;
        best.time = best.time.min(started.elapsed());
        best.rays = progress.stats().rays;
        drop(progress);

        let timed = |pixel, row: &mut RenderStats| {
            let mut stats = RenderStats {
                time_in_hit: Some(Duration::ZERO),
                ..RenderStats::default()
            };
            let started = Instant::now();
            black_box(renderer.sample_radiance(pixel, 0, &mut stats));
            row.rays += stats.rays;
            (started.elapsed(), stats.time_in_hit.unwrap_or_default())
        };
        let progress = Progress::new(u64::from(job.pool.size().y), "");
        let pixels = job.pool.render(&progress, timed)?;
        let all: Duration = pixels.iter().map(|(all, _)| all).sum();
        let in_hit: Duration = pixels.iter().map(|(_, in_hit)| in_hit).sum();
        if all < shortest {
            shortest = all;
            best.share_in_hit = in_hit.as_secs_f64() / all.as_secs_f64().max(1e-9);
        }
    }
    Ok(best)
}

impl Measurement {
    /// Returns the number of rays per second, in millions.
    fn speed(&self) -> f64 {
        self.rays as f64 * 1e-6 / self.time.as_secs_f64().max(1e-9)
    }

    /// Compares this measurement with the measurement stored in `file`, if any, and then replaces
    /// the stored measurement. Returns the lines to print.
    pub(super) fn compare(&self, file: &Path) -> Result<String, RenderError> {
        let speed = self.speed();
        let mut text = format!(
            "{speed:.2} Mrays/s: {:.2} Mrays in {:.0} ms, the fastest of {RUNS} runs\n\
             {:.0}% of the time is spent in Bvh::hit and the functions it calls",
            self.rays as f64 * 1e-6,
            self.time.as_secs_f64() * 1e3,
            100.0 * self.share_in_hit,
        );
        let stored = fs::read_to_string(file).ok();
        let last = stored.and_then(|text| text.trim().parse::<f64>().ok());
        if let Some(last) = last.filter(|last| *last > 0.0) {
            let factor = speed / last;
            write!(
                text,
                "\nlast time: {last:.2} Mrays/s; this run is {factor:.2} times as fast"
            )
            .expect("writing to a string cannot fail");
        }
        let folder = file.parent().unwrap_or(Path::new("."));
        let written = fs::create_dir_all(folder).and_then(|()| fs::write(file, speed.to_string()));
        written.map_err(|error| {
            RenderError::Other(format!("cannot write {}: {error}", file.display()))
        })?;
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::Folder;

    #[test]
    fn a_measurement_is_compared_with_the_last_one() {
        let folder = Folder::new();
        let file = folder.0.join("target/bench/scene.txt");
        let lines = |millis| {
            let measurement = Measurement {
                rays: 500_000,
                time: Duration::from_millis(millis),
                share_in_hit: 0.75,
            };
            measurement.compare(&file).expect("the file can be written")
        };
        let first = "2.00 Mrays/s: 0.50 Mrays in 250 ms, the fastest of 7 runs\n\
                     75% of the time is spent in Bvh::hit and the functions it calls";
        assert_eq!(lines(250), first);
        let second = lines(125);
        let ends = "\nlast time: 2.00 Mrays/s; this run is 2.00 times as fast";
        assert!(second.ends_with(ends), "{second}");
    }
}
