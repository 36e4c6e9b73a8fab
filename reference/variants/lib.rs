//! The variants of `bvh.rs` that are made for speed, with the reference's other files, so that the
//! benchmarks can use them. All other variants are only graded: `cargo author prove` compiles them
//! like submissions.

// A variant finds these modules at the root of its crate, as a submission's file does.
use reference::{bbox, primitive, triangle};

/// Implementations of [`reference::bvh`].
pub mod bvh {
    pub mod tuned;
    pub mod wide;
}
