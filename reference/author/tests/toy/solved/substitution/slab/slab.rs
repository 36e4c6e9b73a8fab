//! The submission's `slab.rs`.

pub use submission::slab::{Slab, nearest};
