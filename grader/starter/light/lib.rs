//! Part two, light: from materials to a path tracer.
//!
//! You write the task files, in this order: [`material`], [`lights`], [`direct`], [`path`] and
//! [`environment`]. The other files, [`world`], [`integrator`] and [`exam`], are given.

#![forbid(unsafe_code)]

pub mod direct;
pub mod environment;
pub mod exam;
pub mod integrator;
pub mod lights;
pub mod material;
pub mod path;
pub mod world;
