//! The crate that compiles a submission's `path.rs` with the reference's parts.

pub use parts::*;

pub mod path;
