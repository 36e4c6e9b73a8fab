//! Many jobs on a few threads: each takes the next one when it is done with its own.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// What `work` makes of each job, in the order of the jobs. It is told the slot that it works in.
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
                    let place = next.fetch_add(1, Ordering::Relaxed);
                    let Some(job) = jobs.get(place) else { break };
                    let result = work(slot, job);
                    *results[place]
                        .lock()
                        .expect("nobody panics while holding it") = Some(result);
                }
            });
        }
    });
    let done = results.into_iter();
    done.map(|result| result.into_inner().expect("nobody panics while holding it"))
        .map(|result| result.expect("every job was taken"))
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
