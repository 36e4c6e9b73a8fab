//! The code given to students: scenes, random numbers, the path tracer, pictures, and the probe
//! that answers the grader.
//!
//! Nothing here solves a task. This crate calls the students' code only through the traits in
//! [`submission`].

pub mod answer;
pub mod attempt;
#[cfg(feature = "cli")]
pub mod cli;
pub mod film;
mod frame;
pub mod integrator;
pub mod light;
pub mod math;
pub mod probe;
pub mod sampler;
pub mod scene;
#[cfg(test)]
mod sphere_submission;
pub mod submission;
mod suggestion;
mod system;
#[cfg(feature = "cli")]
pub mod view;
