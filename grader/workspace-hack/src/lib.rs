//! This crate is empty. It exists only to enable the features listed in `Cargo.toml`.
