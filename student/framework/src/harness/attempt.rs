//! Runs a submission's code and turns panics into values.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};

use protocol::{Attempts, ElementOutcome, Panic};

thread_local! {
    /// The location of this thread's last panic. Only the panic hook receives the location, and
    /// only [`attempt`] can report it.
    static LOCATION: RefCell<String> = const { RefCell::new(String::new()) };
    /// Whether this thread is inside an [`attempt`].
    static ATTEMPTING: Cell<bool> = const { Cell::new(false) };
}

/// Installs a panic hook that prints nothing for a panic inside an [`attempt`], because `attempt`
/// returns the panic's message and location. Other panics are bugs in the framework and are printed
/// as before.
pub fn keep_panics_quiet() {
    let previous_hook = take_hook();
    set_hook(Box::new(move |panic| {
        if !ATTEMPTING.get() {
            return previous_hook(panic);
        }
        let location = panic.location().map(ToString::to_string);
        LOCATION.with(|cell| *cell.borrow_mut() = location.unwrap_or_default());
    }));
}

/// Runs `code` and returns its value, or the panic if it panics.
pub fn attempt<T>(code: impl FnOnce() -> T) -> Result<T, Panic> {
    // This is unwind safe, because each question has its own values, so values left half-modified
    // by a panic are never used again.
    let before = ATTEMPTING.replace(true);
    let result = catch_unwind(AssertUnwindSafe(code));
    ATTEMPTING.set(before);
    result.map_err(|payload| Panic {
        message: truncate(panic_message(payload.as_ref())),
        location: truncate(&LOCATION.with(RefCell::take)),
    })
}

/// Attempts the calls in one table. After [`Panic::MAX_PER_QUESTION`] panics, the remaining calls
/// are skipped. Otherwise, a stub would panic twenty thousand times for one picture.
#[derive(Debug, Default)]
pub struct AttemptsAtTable {
    panics: usize,
}

impl Attempts for AttemptsAtTable {
    fn attempt(&mut self, call: &mut dyn FnMut()) -> ElementOutcome<()> {
        if self.panics == Panic::MAX_PER_QUESTION {
            return ElementOutcome::Skipped;
        }
        let result = attempt(call);
        self.panics += usize::from(result.is_err());
        result.into()
    }
}

/// Extracts the message from a panic's payload.
fn panic_message(payload: &(dyn Any + Send)) -> &str {
    payload
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| payload.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}

/// Truncates text to [`Panic::MAX_TEXT_BYTES`], at a character boundary.
fn truncate(text: &str) -> String {
    text[..text.floor_char_boundary(Panic::MAX_TEXT_BYTES)].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_affects_only_its_own_element() {
        let mut attempts = AttemptsAtTable::default();
        let mut attempt = |n: i32| attempts.attempt(&mut || assert!(10 / n > 0));
        assert_eq!(attempt(1), ElementOutcome::Value(()));
        assert!(matches!(attempt(0), ElementOutcome::Panicked(p) if p.message.contains("zero")));
        assert_eq!(attempt(2), ElementOutcome::Value(()));
    }

    #[test]
    fn skips_the_rest_after_several_panics() {
        let mut attempts = AttemptsAtTable::default();
        let outcomes = [(); 5].map(|()| attempts.attempt(&mut || todo!("task 1")));
        let given_up = outcomes.iter().filter(|o| **o == ElementOutcome::Skipped);
        assert_eq!(given_up.count(), 5 - Panic::MAX_PER_QUESTION);
        assert!(matches!(&outcomes[0], ElementOutcome::Panicked(p) if p.is_unimplemented()));
    }

    #[test]
    fn truncates_a_long_message_at_a_character_boundary() {
        let message = "é".repeat(Panic::MAX_TEXT_BYTES);
        let panic = attempt(|| panic!("{message}")).expect_err("the code panics");
        assert!(panic.message.len() <= Panic::MAX_TEXT_BYTES && !panic.message.is_empty());
    }
}
