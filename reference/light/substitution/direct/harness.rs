//! The crate that compiles a submission's `direct.rs` with the reference's parts.

pub use parts::*;

pub mod direct;
