//! Rendering: how a pixel gets its colour.

pub mod clay;
pub mod film;
mod frame;
pub mod integrator;
pub mod light;
mod offset;
pub mod renderer;
pub mod sampler;
mod tracer;
