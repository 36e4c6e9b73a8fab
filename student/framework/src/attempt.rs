//! Running a submission's code so that a panic becomes a value.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};

use protocol::{Outcome, Panic};

thread_local! {
    /// Where this thread panicked last: only the hook is told, only the catcher can say.
    static PLACE: RefCell<String> = const { RefCell::new(String::new()) };
    /// Whether this thread is inside an [`attempt`].
    static ATTEMPTING: Cell<bool> = const { Cell::new(false) };
}

/// From now on panics inside an [`attempt`] print nothing: it reports them, with their place. All
/// others are mistakes of the framework, and as loud as before.
pub fn keep_panics_quiet() {
    let loud = take_hook();
    set_hook(Box::new(move |panic| {
        if !ATTEMPTING.get() {
            return loud(panic);
        }
        let place = panic.location().map_or(String::new(), |location| {
            format!("{}:{}", location.file(), location.line())
        });
        PLACE.with(|cell| *cell.borrow_mut() = place);
    }));
}

/// What `code` returns, or how it panicked.
pub fn attempt<T>(code: impl FnOnce() -> T) -> Outcome<T> {
    // Nothing that a panic leaves half done is looked at again: each question has its own values.
    let before = ATTEMPTING.replace(true);
    let result = catch_unwind(AssertUnwindSafe(code));
    ATTEMPTING.set(before);
    match result {
        Ok(value) => Outcome::Value(value),
        Err(payload) => Outcome::Panicked(Panic {
            message: shortened(words(payload.as_ref())),
            place: shortened(&PLACE.with(RefCell::take)),
        }),
    }
}

/// [`attempt`] for each element. After [`Panic::PATIENCE`] panics the rest are given up: a stub
/// asked for a whole picture would otherwise panic twenty thousand times.
pub fn each<Q, T>(asked: &[Q], mut code: impl FnMut(&Q) -> T) -> Vec<Outcome<T>> {
    let mut panics = 0;
    let answer = |element| {
        if panics == Panic::PATIENCE {
            return Outcome::GivenUp;
        }
        let outcome = attempt(|| code(element));
        panics += usize::from(matches!(outcome, Outcome::Panicked(_)));
        outcome
    };
    asked.iter().map(answer).collect()
}

/// What `panic!` was given; anything but text has no words.
fn words(payload: &(dyn Any + Send)) -> &str {
    payload
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| payload.downcast_ref::<&str>().copied())
        .unwrap_or("a panic without a message")
}

fn shortened(text: &str) -> String {
    text[..text.floor_char_boundary(Panic::LONGEST)].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_costs_its_own_element() {
        let outcomes = each(&[1, 0, 2], |&n| 10 / n);
        assert_eq!(outcomes[0], Outcome::Value(10));
        assert!(matches!(&outcomes[1], Outcome::Panicked(p) if p.message.contains("zero")));
        assert_eq!(outcomes[2], Outcome::Value(5));
    }

    #[test]
    fn after_some_panics_the_rest_is_given_up() {
        let outcomes: Vec<Outcome<()>> = each(&[(); 5], |()| todo!("task 1"));
        let given_up = outcomes.iter().filter(|o| **o == Outcome::GivenUp);
        assert_eq!(given_up.count(), 5 - Panic::PATIENCE);
        assert!(matches!(&outcomes[0], Outcome::Panicked(p) if p.is_unimplemented()));
    }

    #[test]
    fn a_long_message_is_cut_between_characters() {
        let outcome: Outcome<()> = attempt(|| panic!("{}", "é".repeat(Panic::LONGEST)));
        let Outcome::Panicked(panic) = outcome else {
            unreachable!("it panicked")
        };
        assert!(panic.message.len() <= Panic::LONGEST && !panic.message.is_empty());
    }
}
