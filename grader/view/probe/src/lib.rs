//! The part of `cargo view` that is linked with a submission.
//!
//! The viewer compiles a submission's files together with this crate instead of with the grader's
//! probe. The program draws tiles of a picture with the submission's code. A second program, in
//! which `BBox::hit` and `Primitive::hit` inform [`record`] of every call, lists the tests made for
//! a ray, and [`rules`] marks the steps that no correct traversal takes. Neither program is used
//! for grading.

mod draw;
pub mod indexed_tree;
pub mod messages;
mod open_scene;
pub mod record;
pub mod rules;
pub mod scene_data;
mod serve;

pub use serve::main;
