//! Many threads, one picture.

use glam::UVec2;
use protocol::Outcome;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::failure::{Accident, Failure};
use super::progress::Progress;
use crate::attempt::attempt;
use crate::integrator::Tally;
use crate::probe::STACK_BYTES;

/// A film, and the threads to fill it.
pub(super) struct Canvas {
    size: UVec2,
    threads: ThreadPool,
}

impl Canvas {
    /// As many threads as asked for, or one for each core.
    pub(super) fn new(size: UVec2, threads: Option<u16>) -> Result<Self, Failure> {
        let threads = ThreadPoolBuilder::new()
            .num_threads(threads.map_or(0, usize::from))
            .stack_size(STACK_BYTES)
            .build()?;
        Ok(Canvas { size, threads })
    }

    /// Runs `code` on one of the threads, whose stack is as large as in grading.
    pub(super) fn with_room<T: Send>(&self, code: impl FnOnce() -> T + Send) -> T {
        self.threads.install(code)
    }

    /// What `pixel` makes of each pixel, row by row from the bottom. Each row is one piece of
    /// work; which thread does it makes no difference. Ends early at a panic.
    pub(super) fn draw<T: Send>(
        &self,
        progress: &Progress,
        pixel: impl Fn(UVec2, &mut Tally) -> T + Sync,
    ) -> Result<(Vec<T>, Tally), Failure> {
        let row = |y| {
            let mut tally = Tally::default();
            let mut one = |x| {
                let place = UVec2::new(x, y);
                finished(attempt(|| pixel(place, &mut tally)), Some(place))
            };
            let row: Vec<T> = (0..self.size.x).map(&mut one).collect::<Result<_, _>>()?;
            progress.row(tally);
            Ok((row, tally))
        };
        let rows = || (0..self.size.y).into_par_iter().map(row).collect();
        let rows: Result<Vec<(Vec<T>, Tally)>, Failure> = self.threads.install(rows);
        let (rows, tallies): (Vec<Vec<T>>, Vec<Tally>) = rows?.into_iter().unzip();
        let tally = tallies.into_iter().fold(Tally::default(), Tally::and);
        Ok((rows.into_iter().flatten().collect(), tally))
    }
}

/// The value, or why there is none.
pub(super) fn finished<T>(outcome: Outcome<T>, pixel: Option<UVec2>) -> Result<T, Failure> {
    match outcome {
        Outcome::Value(value) => Ok(value),
        Outcome::Panicked(panic) => Err(Failure::Accident(Accident { panic, pixel })),
        Outcome::GivenUp => unreachable!("only lists are given up"),
    }
}

#[cfg(test)]
mod tests {
    use glam::uvec2;

    use super::*;

    fn drawn(threads: u16) -> (Vec<UVec2>, Tally) {
        let canvas = Canvas::new(uvec2(5, 7), Some(threads)).expect("threads");
        let pixel = |place: UVec2, tally: &mut Tally| {
            tally.rays += u64::from(place.x);
            place
        };
        canvas.draw(&Progress::new(7), pixel).expect("no panic")
    }

    #[test]
    fn any_number_of_threads_draws_the_same_from_the_bottom_up() {
        let (pixels, tally) = drawn(1);
        assert_eq!(drawn(3), (pixels.clone(), tally));
        assert_eq!(pixels[1], uvec2(1, 0));
        assert_eq!(pixels[5], uvec2(0, 1));
        assert_eq!(tally.rays, 7 * (1 + 2 + 3 + 4));
    }

    #[test]
    fn a_panic_ends_the_picture_and_tells_the_pixel() {
        let canvas = Canvas::new(uvec2(2, 1), Some(1)).expect("threads");
        let pixel = |place: UVec2, _: &mut Tally| assert!(place.x == 0, "too far");
        let failure = canvas
            .draw(&Progress::new(1), pixel)
            .expect_err("it panics");
        assert!(matches!(
            failure,
            Failure::Accident(accident) if accident.pixel == Some(uvec2(1, 0))
        ));
    }
}
