//! The words that both towers of this project speak: the grader, which asks, and a submission's
//! probe, which answers.
//!
//! Plain data only: nothing here knows how a ray meets a sphere. What may travel is a [`Question`]
//! and its [`Answer`]; how they travel is in [`wire`].

pub mod answer;
mod interval;
pub mod packed;
pub mod question;
mod ray;
mod shape;
mod trace;
mod tree;
mod vertex;
mod view;
pub mod wire;

pub use answer::{Answer, ElementOutcome, Panic};
pub use interval::Interval;
pub use question::Question;
pub use ray::Ray;
pub use shape::Shape;
pub use trace::Trace;
pub use tree::{Tree, TreeNode};
pub use vertex::Vertex;
pub use view::{ExamCamera, PIXEL_OFFSETS, PinholeCamera, Rays, Sample, Samples, every_pixel};

// Former names, so that submissions written before they changed still compile.
#[doc(hidden)]
pub use answer::ElementOutcome as Outcome;
#[doc(hidden)]
pub use view::{ExamCamera as View, PIXEL_OFFSETS as OFFSETS};
