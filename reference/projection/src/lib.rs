//! Projects a task file of the reference, where solutions are marked, to one of two things:
//!
//! - [`starter`]: the file that students get, with stubs instead of the solutions
//! - [`Replacement::given_code`]: the given code that a variant, another solution, needs to be a
//!   complete file
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
pub use starter::starter;
