//! Runs a queue of jobs on a few threads. A thread takes the next job as soon as it finishes one.
//!
//! This doesn't use `rayon`, for two reasons: the progress display shows a line for each thread,
//! and entries should be graded in the order of the list, so that a stopped run has graded the
//! first entries. `rayon` splits the list into halves, and `par_bridge` doesn't preserve the order
//! of the results.

use std::iter;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Runs `work` for each job. Returns the results in the order of the jobs. The first argument of
/// `work` is the index of the thread, from 0 to `slots` - 1.
pub fn run<J: Sync, R: Send>(
    jobs: &[J],
    slots: usize,
    work: impl Fn(usize, &J) -> R + Sync,
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let take_jobs = |slot: usize| -> Vec<(usize, R)> {
        let indices = iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
        let taken = indices.map_while(|index| Some((index, jobs.get(index)?)));
        taken.map(|(index, job)| (index, work(slot, job))).collect()
    };
    let take_jobs = &take_jobs;
    let mut results: Vec<(usize, R)> = thread::scope(|scope| {
        let slots = 0..slots.min(jobs.len());
        let threads = slots.map(|slot| scope.spawn(move || take_jobs(slot)));
        let threads: Vec<_> = threads.collect();
        let results = threads.into_iter().map(|thread| thread.join());
        let results = results.map(|result| result.unwrap_or_else(|panic| resume_unwind(panic)));
        results.flatten().collect()
    });
    results.sort_unstable_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_jobs() {
        let jobs: Vec<usize> = (0..100).collect();
        let doubled = run(&jobs, 7, |_, job| 2 * job);
        assert_eq!(doubled, jobs.iter().map(|job| 2 * job).collect::<Vec<_>>());
        assert!(run(&Vec::<usize>::new(), 7, |_, job| *job).is_empty());
    }
}
