//! The crate in which a submission's `mirror.rs` is compiled with the reference's `ball.rs`.

pub use parts::ball;

pub mod mirror;
