//! A toy assignment: two files, three tasks.

pub mod ball;
pub mod slab;
pub mod world;
