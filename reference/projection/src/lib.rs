//! Turns a task file of the reference, which marks the solutions, into one of three things:
//!
//! - [`starter`]: the file that students get, with stubs instead of the solutions
//! - [`solution`]: the file with the solutions, but without the marks
//! - [`Replacement::given_code`]: the given code that turns a variant, which is another solution,
//!   into a complete file
//!
//! This is a separate package because both `author` and the build script of `variants` use it.

mod given_code;
mod item;
mod marks;
mod replacement;
mod starter;

pub use given_code::GivenCodeError;
pub use marks::{MarkError, MarkProblem};
pub use replacement::{ReadError, Replacement, replacements};
pub use starter::{solution, starter};
