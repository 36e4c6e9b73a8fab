//! The crate in which a submission's `bvh.rs` is compiled when it is graded with the reference's
//! parts. The reference's other files replace those of the submission.

pub use parts::*;

pub mod bvh;
