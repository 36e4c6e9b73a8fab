//! Many threads, one picture.

use glam::UVec2;
use protocol::ElementOutcome;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::error::{RenderError, SubmissionPanic};
use super::progress::Progress;
use crate::attempt::attempt;
use crate::integrator::RenderStats;
use crate::probe::STACK_BYTES;

/// A film, and the threads to fill it.
pub(super) struct RenderPool {
    size: UVec2,
    threads: ThreadPool,
}

impl RenderPool {
    /// As many threads as asked for, or one for each core.
    pub(super) fn new(size: UVec2, threads: Option<u16>) -> Result<Self, RenderError> {
        let threads = ThreadPoolBuilder::new()
            .num_threads(threads.map_or(0, usize::from))
            .stack_size(STACK_BYTES)
            .build()?;
        Ok(RenderPool { size, threads })
    }

    /// Runs `code` on one of the threads, whose stack is as large as in grading.
    pub(super) fn run<T: Send>(&self, code: impl FnOnce() -> T + Send) -> T {
        self.threads.install(code)
    }

    /// What `pixel` makes of each pixel, row by row from the bottom. Each row is one piece of
    /// work; which thread does it makes no difference. Ends early at a panic.
    pub(super) fn render<T: Send>(
        &self,
        progress: &Progress,
        pixel: impl Fn(UVec2, &mut RenderStats) -> T + Sync,
    ) -> Result<(Vec<T>, RenderStats), RenderError> {
        let row = |y| {
            let mut tally = RenderStats::default();
            let mut one = |x| {
                let place = UVec2::new(x, y);
                value_or_error(attempt(|| pixel(place, &mut tally)), Some(place))
            };
            let row: Vec<T> = (0..self.size.x).map(&mut one).collect::<Result<_, _>>()?;
            progress.finish_row(tally);
            Ok((row, tally))
        };
        let rows = || (0..self.size.y).into_par_iter().map(row).collect();
        let rows: Result<Vec<(Vec<T>, RenderStats)>, RenderError> = self.threads.install(rows);
        let (rows, tallies): (Vec<Vec<T>>, Vec<RenderStats>) = rows?.into_iter().unzip();
        let tally = tallies
            .into_iter()
            .fold(RenderStats::default(), RenderStats::merge);
        Ok((rows.into_iter().flatten().collect(), tally))
    }
}

/// The value, or why there is none.
pub(super) fn value_or_error<T>(
    outcome: ElementOutcome<T>,
    pixel: Option<UVec2>,
) -> Result<T, RenderError> {
    match outcome {
        ElementOutcome::Value(value) => Ok(value),
        ElementOutcome::Panicked(panic) => {
            Err(RenderError::Accident(SubmissionPanic { panic, pixel }))
        }
        ElementOutcome::Skipped => unreachable!("only lists are given up"),
    }
}

#[cfg(test)]
mod tests {
    use glam::uvec2;

    use super::*;

    fn drawn(threads: u16) -> (Vec<UVec2>, RenderStats) {
        let canvas = RenderPool::new(uvec2(5, 7), Some(threads)).expect("threads");
        let pixel = |place: UVec2, tally: &mut RenderStats| {
            tally.rays += u64::from(place.x);
            place
        };
        canvas.render(&Progress::new(7), pixel).expect("no panic")
    }

    #[test]
    fn any_number_of_threads_gives_the_same_pixels() {
        let (pixels, tally) = drawn(1);
        assert_eq!(drawn(3), (pixels.clone(), tally));
        assert_eq!(pixels[1], uvec2(1, 0));
        assert_eq!(pixels[5], uvec2(0, 1));
        assert_eq!(tally.rays, 7 * (1 + 2 + 3 + 4));
    }

    #[test]
    fn a_panic_stops_rendering_and_reports_the_pixel() {
        let canvas = RenderPool::new(uvec2(2, 1), Some(1)).expect("threads");
        let pixel = |place: UVec2, _: &mut RenderStats| assert!(place.x == 0, "too far");
        let failure = canvas
            .render(&Progress::new(1), pixel)
            .expect_err("it panics");
        assert!(matches!(
            failure,
            RenderError::Accident(accident) if accident.pixel == Some(uvec2(1, 0))
        ));
    }
}
