//! The submission's `path.rs`.

pub use submission::path::radiance;
