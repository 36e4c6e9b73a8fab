//! The path-tracing assignment: from camera rays to a bounding volume hierarchy.
//!
//! You write the files of the tasks, from [`camera`] to [`bvh`]. Only these are graded. [`primitive`]
//! and [`world`] are given.

#![forbid(unsafe_code)]

pub mod bbox;
pub mod bvh;
pub mod camera;
pub mod primitive;
pub mod sphere;
pub mod triangle;
pub mod world;
