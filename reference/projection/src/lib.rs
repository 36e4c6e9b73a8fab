//! Projects a task file of the reference, in which solutions are marked, to one of two things:
//!
//! - [`starter`]: the file that students get, with stubs instead of the solutions
//! - [`given_code`]: the given code that a variant, another solution, needs to be a complete file
//!
//! This is a package of its own because both `author` and the build script of `variants` use it.

mod given_code;
mod item;
mod marks;
mod starter;

pub use given_code::{GivenCodeError, given_code};
pub use marks::{MarkError, MarkProblem};
pub use starter::starter;
