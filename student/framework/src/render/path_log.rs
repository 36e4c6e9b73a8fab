//! A log of one path: what the path tracer asks about the scene, and the answers.

use std::cell::RefCell;

use crate::render::path_steps::Step;

/// The maximum number of steps in a log. Further steps are left out, so that the log of a path that
/// never ends doesn't fill the memory.
pub const MAX_STEPS: usize = 1 << 12;

thread_local! {
    /// The steps so far, or `None` while no path is followed.
    static STEPS: RefCell<Option<Vec<Step>>> = const { RefCell::new(None) };
}

/// Ends the log when it is dropped, so that it also ends if the path's code panics.
struct Following;

impl Drop for Following {
    fn drop(&mut self) {
        STEPS.set(None);
    }
}

/// Runs code that traces a path. Returns its result and the steps that it logs, in order.
pub fn follow<T>(path: impl FnOnce() -> T) -> (T, Vec<Step>) {
    STEPS.set(Some(Vec::new()));
    let _following = Following;
    let value = path();
    (value, STEPS.take().unwrap_or_default())
}

/// Returns whether a path is followed.
pub fn is_following() -> bool {
    STEPS.with_borrow(Option::is_some)
}

/// Adds a step to the log if a path is followed. Otherwise, the step isn't created.
pub fn log(step: impl FnOnce() -> Step) {
    STEPS.with_borrow_mut(|steps| {
        if let Some(steps) = steps
            && steps.len() < MAX_STEPS
        {
            steps.push(step());
        }
    });
}

/// Returns the number of steps so far. It is 0 if no path is followed.
pub fn step_count() -> usize {
    STEPS.with_borrow(|steps| steps.as_ref().map_or(0, Vec::len))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harness::attempt::attempt;

    #[test]
    fn steps_are_only_kept_while_a_path_is_followed() {
        log(|| unreachable!("no path is followed"));
        let (value, steps) = follow(|| {
            log(|| Step::Miss);
            log(|| Step::Absorbed);
            assert_eq!(step_count(), 2);
            7
        });
        assert_eq!((value, steps), (7, vec![Step::Miss, Step::Absorbed]));
        assert_eq!((follow(|| ()).1, step_count()), (Vec::new(), 0));
    }

    #[test]
    fn a_log_ends_at_a_panic_and_never_grows_without_limit() {
        let panicking = attempt(|| follow(|| panic!("in the path")));
        assert!(panicking.is_err() && !is_following());
        let (_, steps) = follow(|| (0..=MAX_STEPS).for_each(|_| log(|| Step::Miss)));
        assert_eq!(steps.len(), MAX_STEPS);
    }
}
