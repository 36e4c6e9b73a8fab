//! The crate that compiles a submission's `mirror.rs` with the reference's `ball.rs`.

pub use parts::*;

pub mod mirror;
