//! Types shared by the grader, which asks questions, and the probe, the process that runs a
//! submission and answers the questions.
//!
//! This crate contains plain data and the traits of a submission, but no intersection code. The
//! grader sends a [`Question`] and receives an [`Answer`]. The module [`wire`] defines how both are
//! encoded.

pub mod answer;
pub mod function;
mod interval;
pub mod packed;
mod question;
mod ray;
pub mod sampler;
mod shape;
pub mod submission;
mod tree;
pub mod value;
mod view;
pub mod wire;

pub use answer::{Answer, ElementOutcome, Panic, RowOutcome};
pub use function::*;
pub use interval::Interval;
pub use ray::{Ray, Trace};
pub use shape::{Shape, Vertex};
pub use submission::{Aggregate, CameraRays, Hierarchy};
pub use tree::{Tree, TreeNode};
pub use value::{Fields, Record, Value};
pub use view::{ExamCamera, PIXEL_OFFSETS, PinholeCamera, Sample, every_pixel};
