//! A toy assignment: two files, three tasks.

pub mod ball;
pub mod mirror;
pub mod world;
