//! This crate is empty. It only exists for the features in `Cargo.toml`.
