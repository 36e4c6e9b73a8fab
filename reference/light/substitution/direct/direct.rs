//! The submission's `direct.rs`.

pub use submission::direct::direct;
