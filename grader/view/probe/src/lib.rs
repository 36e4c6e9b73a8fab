//! The part of `cargo view` that is linked with a submission.
//!
//! The viewer compiles a submission's files together with this crate instead of with the grader's
//! probe. The program draws tiles of a picture with the submission's code. A second program, where
//! `BBox::hit` and `Primitive::hit` report their calls to [`record`], lists the tests of a ray.
//! Neither is used for grading.

mod draw;
pub mod messages;
pub mod record;
pub mod scene_data;
mod serve;
mod stage;

pub use serve::main;
