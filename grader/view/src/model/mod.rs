//! Pure parts of the viewer: no threads, files or clocks.

pub mod explanation;
pub mod history;
pub mod layer;
pub mod tiles;
pub mod tree;
pub mod viewpoint;
