//! The path tracer: how a pixel gets its colour.

pub mod film;
mod frame;
pub mod integrator;
pub mod light;
pub mod sampler;
