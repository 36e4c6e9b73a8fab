//! Pure parts of the viewer: no threads, files or clocks.

pub mod bounds;
pub mod explanation;
pub mod layer;
pub mod rules;
pub mod tree;
pub mod viewpoint;
