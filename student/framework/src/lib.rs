//! The code given to students: scenes, random numbers, pictures, and the probe that answers the
//! grader.
//!
//! Nothing here solves a task. This crate calls the students' code only through the traits in
//! [`submission`].
//!
//! To see how a pixel gets its colour, read [`render`] in this order:
//! [`sampler`](render::sampler), where random numbers come from;
//! [`clay`](render::clay), the simplest renderer, which asks your code for two hits per sample;
//! [`tracer`](render::tracer), which checks these hits; and
//! [`film`](render::film), which turns light into the colours of a screen. The path tracer, which
//! follows paths of light from hit to hit, is part two: `student/light`.
//!
//! Modules only use modules in lower rows:
//!
//! | layer | modules |
//! |---|---|
//! | programs | [`harness`] |
//! | pictures | [`render`] |
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
