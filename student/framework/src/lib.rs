//! The code given to students: scenes, random numbers, the path tracer, pictures, and the probe
//! that answers the grader.
//!
//! Nothing here solves a task. This crate calls the students' code only through the traits in
//! [`submission`].
//!
//! To see how a pixel gets its colour, read [`render`] in this order:
//! [`sampler`](render::sampler), where random numbers come from;
//! [`clay`](render::clay), the simplest renderer, which asks your code for two hits per sample;
//! [`integrator`](render::integrator), which follows paths of light;
//! [`light`](render::light), which chooses points on light sources; and
//! [`film`](render::film), which turns light into the colours of a screen.
//!
//! Modules only use modules in lower rows:
//!
//! | layer | modules |
//! |---|---|
//! | programs | [`harness`] |
//! | the path tracer | [`render`] |
//! | the students' code, as traits | [`submission`] |
//! | scene files | [`scene`] |
//! | helpers | [`math`], `suggestion` |

pub mod harness;
pub mod math;
pub mod render;
pub mod scene;
pub mod submission;
mod suggestion;
#[cfg(test)]
mod tests;
