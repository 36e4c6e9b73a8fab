//! Renders a picture with many threads.

use glam::{UVec2, Vec3};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::canvas::{Canvas, passes};
use super::error::{RenderError, call};
use super::progress::Progress;
use crate::harness::probe::STACK_BYTES;
use crate::render::renderer::RenderStats;

/// The name given to the threads, which appears in the message about a stack overflow.
const THREAD_NAME: &str = "a ray (in Camera::sample_ray, Bvh::hit, BBox::hit, Triangle::hit or \
                           Sphere::hit)";

/// The size of a film and the threads that render it.
pub(super) struct RenderPool {
    size: UVec2,
    threads: ThreadPool,
}

impl RenderPool {
    /// Starts this many threads, or one per core if `threads` is `None`.
    pub(super) fn new(size: UVec2, threads: Option<u16>) -> Result<Self, RenderError> {
        let threads = ThreadPoolBuilder::new()
            .num_threads(threads.map_or(0, usize::from))
            .stack_size(STACK_BYTES)
            .thread_name(|_| THREAD_NAME.to_owned())
            .build()
            .map_err(RenderError::threads)?;
        Ok(RenderPool { size, threads })
    }

    /// Returns the width and height of the film, in pixels.
    pub(super) fn size(&self) -> UVec2 {
        self.size
    }

    /// Returns the number of threads.
    pub(super) fn threads(&self) -> usize {
        self.threads.current_num_threads()
    }

    /// Calls `pixel` for each pixel and returns the results, row by row from the bottom. A panic
    /// stops the rendering.
    pub(super) fn render<T: Send>(
        &self,
        progress: &Progress,
        pixel: impl Fn(UVec2, &mut RenderStats) -> T + Sync,
    ) -> Result<Vec<T>, RenderError> {
        let rows = self.rows(|y| {
            let mut stats = RenderStats::default();
            let row = self.row(y, |position, _| pixel(position, &mut stats))?;
            progress.finish_row(stats, 1);
            Ok(row)
        })?;
        Ok(rows.into_iter().flatten().collect())
    }

    /// Adds samples to each pixel of the canvas. The first pass adds one sample, and each later
    /// pass doubles the number of samples. A pixel's samples are added in order, so the picture
    /// doesn't depend on the division into passes.
    pub(super) fn accumulate(
        &self,
        progress: &Progress,
        canvas: &Canvas,
        samples: u32,
        sample: impl Fn(UVec2, u32, &mut RenderStats) -> Vec3 + Sync,
    ) -> Result<(), RenderError> {
        for pass in passes(samples) {
            self.rows(|y| {
                let mut row = canvas.row(y);
                let mut stats = RenderStats::default();
                row.sums = self.row(y, |position, x| {
                    let add = |sum, number| sum + sample(position, number, &mut stats);
                    pass.clone().fold(row.sums[x], add)
                })?;
                row.samples = pass.end;
                canvas.set_row(y, row);
                progress.finish_row(stats, pass.len() as u64);
                Ok(())
            })?;
        }
        Ok(())
    }

    /// Calls `row` for each row. Threads take one row at a time, and the result doesn't depend on
    /// which thread takes which row.
    fn rows<R: Send>(
        &self,
        row: impl Fn(u32) -> Result<R, RenderError> + Sync,
    ) -> Result<Vec<R>, RenderError> {
        self.threads
            .install(|| (0..self.size.y).into_par_iter().map(&row).collect())
    }

    /// Calls `pixel` for each pixel of a row, with its position and its index in the row.
    fn row<T>(
        &self,
        y: u32,
        mut pixel: impl FnMut(UVec2, usize) -> T,
    ) -> Result<Vec<T>, RenderError> {
        let mut one = |x: u32| {
            let position = UVec2::new(x, y);
            call(Some(position), || pixel(position, x as usize))
        };
        (0..self.size.x).map(&mut one).collect()
    }
}

#[cfg(test)]
mod tests {
    use glam::uvec2;

    use super::*;

    fn render(threads: u16) -> (Vec<UVec2>, RenderStats) {
        let pool = RenderPool::new(uvec2(5, 7), Some(threads)).expect("threads can be started");
        let pixel = |position: UVec2, stats: &mut RenderStats| {
            stats.rays += u64::from(position.x);
            position
        };
        let progress = Progress::new(7, "");
        let pixels = pool.render(&progress, pixel);
        (pixels.expect("the code does not panic"), progress.stats())
    }

    #[test]
    fn any_number_of_threads_gives_the_same_pixels() {
        let (pixels, stats) = render(1);
        assert_eq!(render(3), (pixels.clone(), stats));
        assert_eq!(pixels[1], uvec2(1, 0));
        assert_eq!(pixels[5], uvec2(0, 1));
        assert_eq!(stats.rays, 7 * (1 + 2 + 3 + 4));
    }

    #[test]
    fn a_panic_stops_rendering_and_reports_the_pixel() {
        let pool = RenderPool::new(uvec2(2, 1), Some(1)).expect("threads can be started");
        let pixel = |position: UVec2, _: &mut RenderStats| assert!(position.x == 0, "too far");
        let error = pool
            .render(&Progress::new(1, ""), pixel)
            .expect_err("the code panics");
        assert!(matches!(
            error,
            RenderError::Panicked(panic) if panic.pixel == Some(uvec2(1, 0))
        ));
    }
}
