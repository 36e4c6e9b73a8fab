//! Finds a minimal set of primitives that still makes a build overflow the stack, so that the
//! recursion can be followed by hand.

use std::io;

use protocol::{Question, Shape};

use super::{Budget, Crash, Fault, Launcher};

/// The maximum number of programs to start. Each ends within a few milliseconds.
const MAX_ATTEMPTS: usize = 100;

/// Leaves out primitives for as long as a build without them still overflows the stack. Returns the
/// remaining primitives, or `None` if even a build with all primitives doesn't overflow the stack.
///
/// The method is delta debugging (Zeller and Hildebrandt, "Simplifying and Isolating
/// Failure-Inducing Input", IEEE Transactions on Software Engineering 28, 2002): first leave out
/// large parts, then smaller ones, and finally single primitives.
pub fn smallest_overflow(
    launcher: &Launcher,
    shapes: &[Shape],
    max_leaf_size: u32,
    budget: Budget,
) -> io::Result<Option<Vec<Shape>>> {
    let mut attempts = 0;
    let mut overflows = |shapes: &[Shape]| -> io::Result<bool> {
        if attempts == MAX_ATTEMPTS {
            return Ok(false);
        }
        attempts += 1;
        let question = Question::Build {
            shapes: shapes.to_vec(),
            max_leaf_size,
        };
        let mut probe = launcher.start(budget.total_cpu())?;
        let answer = probe.ask([&question], budget.single_item());
        Ok(matches!(answer, Err(Fault::Crashed(Crash::StackOverflow))))
    };
    if !overflows(shapes)? {
        return Ok(None);
    }
    let mut left = shapes.to_vec();
    let mut length = left.len() / 2;
    while length > 0 {
        let mut start = 0;
        while start < left.len() {
            let end = left.len().min(start + length);
            let others = [&left[..start], &left[end..]].concat();
            if !others.is_empty() && overflows(&others)? {
                left = others;
            } else {
                start = end;
            }
        }
        length /= 2;
    }
    Ok(Some(left))
}
