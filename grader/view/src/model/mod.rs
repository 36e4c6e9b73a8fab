//! Pure parts of the viewer: no threads, files or clocks.

pub mod explanation;
pub mod layer;
pub mod tiles;
pub mod tree;
pub mod viewpoint;
