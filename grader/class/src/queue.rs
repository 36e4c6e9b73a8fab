//! Runs a queue of jobs on a few threads. A thread takes the next job as soon as it has finished
//! one.
//!
//! This does not use `rayon`, because the progress display has a line for each thread, and entries
//! are graded in the order of the list, so that a run that is stopped has graded the first ones.
//! `rayon` splits the list into halves, and `par_bridge` does not keep the order of the results.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Runs `work` for each job, and returns the results in the order of the jobs. The first argument
/// of `work` is the index of the thread, from 0 to `slots` - 1.
pub fn run<J: Sync, R: Send>(
    jobs: &[J],
    slots: usize,
    work: impl Fn(usize, &J) -> R + Sync,
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let results: Vec<Mutex<Option<R>>> = jobs.iter().map(|_| Mutex::new(None)).collect();
    thread::scope(|scope| {
        for slot in 0..slots.min(jobs.len()) {
            let (next, results, work) = (&next, &results, &work);
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(job) = jobs.get(index) else { break };
                    let result = work(slot, job);
                    *results[index]
                        .lock()
                        .expect("no thread panics while holding the lock") = Some(result);
                }
            });
        }
    });
    let done = results.into_iter();
    done.map(|result| {
        result
            .into_inner()
            .expect("no thread panics while holding the lock")
    })
    .map(|result| result.expect("every job was run"))
    .collect()
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
