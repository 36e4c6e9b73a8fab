//! Clues, which say what to look for if the way an item failed is more informative than the item
//! itself.

use judging::assignment::TaskInfo;
use judging::signatures::PanicKind;

use crate::probe::{Crash, Fault, TimeLimit};

/// The clue for a question that is answered correctly when rerun in isolation.
pub const KEPT_STATE: &str = "Your code answers the same question correctly in isolation, so it \
                              keeps state from one call to the next, for example in a `static` or \
                              a `Cell`. An answer must depend only on the arguments of its call.";

/// The clue for a panic in one of the submission's lines whose message says nothing about the cause.
pub const UNKNOWN_PANIC: &str = "No method in this task needs to panic. When is that line reached, and \
                                 what does it require? Work out which value in the question shown is the \
                                 reason, and what the method should return instead.";

/// The clue for an answer that is NaN or contains NaN.
pub const NOT_A_NUMBER: &str = "Your answer is NaN, which usually comes from 0 / 0, from ∞ − ∞, or from the square \
                                root of a negative number. Print the values that your answer is computed \
                                from: which is the first one that isn't an ordinary number?";

/// Returns the clue for an item without an answer. `called` is the method that gave none, if it is
/// known.
pub fn of_fault(fault: &Fault, called: Option<&str>, task: &TaskInfo) -> String {
    let TaskInfo { file, clues, .. } = task;
    let method = match called {
        Some(called) => task.method_name(called),
        None => task.method_names("or"),
    };
    match fault {
        Fault::TimedOut(TimeLimit::Waiting) => format!(
            "Find out what {method} in {file} is waiting for: a sleep, a lock, a channel, or \
             input. Nothing in this task needs to wait."
        ),
        Fault::TimedOut(TimeLimit::Cpu | TimeLimit::Wall) => format!(
            "Find the loop or the recursion in {file} that doesn't end, or takes far too long, when {method} \
             is called for this question: what changes from one iteration to the next, and what should end it?"
        ),
        Fault::OutOfMemory => format!(
            "Which list does {method} in {file} keep adding to, and what should make it stop?"
        ),
        Fault::Crashed(Crash::StackOverflow) => match clues.if_stack_overflows {
            Some(clue) => clue.to_owned(),
            None => {
                format!(
                    "Does {method} in {file} call itself, perhaps through another function? Then which argument \
                     gets smaller from call to call, and when does the recursion end? If nothing calls \
                     itself, look for a very large array."
                )
            }
        },
        Fault::Crashed(Crash::Exited(_)) => {
            format!("Look in {file} for `std::process::exit`: a method must return or panic.")
        }
        Fault::Crashed(Crash::NotStarted) => {
            "Look in all of your files for a `static` or a `thread_local!` with a large type, such as \
             a long array."
                .to_owned()
        }
        Fault::Crashed(Crash::Signal(_) | Crash::Killed) | Fault::Protocol(_) => format!(
            "Run this question in isolation, with `--replay`, and see what {method} in {file} \
             does last."
        ),
    }
}

/// Returns the clue for a panic with this message, if any.
pub fn of_panic(message: &str) -> Option<&'static str> {
    // The harness stops reading such a tree.
    if message.starts_with("the tree is too large") {
        return Some(
            "A split puts each primitive on one of two sides, and each side is built once. Draw the tree \
             that your code builds for four primitives: which part of it appears more than once?",
        );
    }
    if message.starts_with("slice index starts at") {
        return Some(
            "The range ends before it starts. A leaf holds the primitives start..start + size: \
             where does your range start and end?",
        );
    }
    // The first message is from a vector, the second from an array of three numbers.
    let is_axis = message == "index out of bounds" || message.contains("the len is 3 ");
    let is_too_large = ["add", "multiply", "shift"]
        .iter()
        .any(|operation| message.starts_with(&format!("attempt to {operation}")));
    Some(match PanicKind::of(message)? {
        PanicKind::Index if is_axis => {
            "Compare the index with the length: is the index one too large, or was it meant for a \
             different list? A vector has the axes 0, 1 and 2."
        }
        PanicKind::Index => {
            "Compare the index with the length: is the index one too large, is the list empty or too \
             short, or was the index meant for a different list?"
        }
        PanicKind::Arithmetic if is_too_large => {
            "The result is too large for the type of these integers. Do you need this calculation? If \
             so, convert them to `f32`, or to a larger type, before you calculate with them."
        }
        PanicKind::Arithmetic if message.starts_with("attempt to subtract") => {
            "`usize` and `u32` can't be negative, and the second number is larger than the first here. \
             Do you need to subtract anything? Should the difference be an `f32`? Then convert both \
             numbers first. Is it an index? Then treat this case separately."
        }
        PanicKind::Arithmetic => {
            "An integer can't be divided by zero. What makes the divisor 0 here, and what should your code \
             do in this case?"
        }
        PanicKind::NoValue => {
            "That line assumes that there is a value. When is there none, and what should your \
             code return then?"
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handed_out::RAYS;

    #[test]
    fn only_an_index_that_can_be_an_axis_is_called_one() {
        for (message, can_be_axis) in [
            ("index out of bounds", true),
            ("index out of bounds: the len is 3 but the index is 3", true),
            (
                "index out of bounds: the len is 12 but the index is 12",
                false,
            ),
            (
                "range end index 133 out of range for slice of length 129",
                false,
            ),
            ("mid > len", false),
        ] {
            let clue = of_panic(message).unwrap();
            assert_eq!(clue.contains("axes"), can_be_axis, "{message}: {clue}");
        }
    }

    #[test]
    fn a_range_that_ends_before_it_starts_is_not_blamed_on_the_length() {
        let clue = of_panic("slice index starts at 3 but ends at 1").unwrap();
        assert!(clue.contains("start..start + size"), "{clue}");
    }

    #[test]
    fn the_clue_on_integers_fits_the_operation() {
        for (message, part) in [
            ("attempt to subtract with overflow", "can't be negative"),
            ("attempt to divide by zero", "divided by zero"),
            ("attempt to add with overflow", "too large"),
            ("attempt to multiply with overflow", "too large"),
        ] {
            let clue = of_panic(message).unwrap();
            assert!(clue.contains(part), "{message}: {clue}");
        }
    }

    #[test]
    fn a_stack_overflow_in_a_build_leads_to_the_split() {
        let clue = |task: &str| {
            let task = RAYS.assignment.find(task).unwrap();
            of_fault(&Fault::Crashed(Crash::StackOverflow), None, task)
        };
        let build = clue("build");
        assert!(build.contains("one side of its split is empty"), "{build}");
        let traverse = clue("traverse");
        assert!(
            traverse.contains("`hit` in bvh.rs call itself"),
            "{traverse}"
        );
    }
}
