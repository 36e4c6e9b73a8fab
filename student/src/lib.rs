//! The path-tracing assignment: from camera rays to a bounding volume hierarchy.
//!
//! You write the task files, from [`camera`] to [`bvh`], and only these are graded. The other
//! files, [`primitive`] and [`world`], are given.

#![forbid(unsafe_code)]

pub mod bbox;
pub mod bvh;
pub mod camera;
pub mod primitive;
pub mod sphere;
pub mod triangle;
pub mod world;
