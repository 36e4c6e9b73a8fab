//! The submission's `mirror.rs`.

pub use submission::mirror::{Mirror, nearest};
