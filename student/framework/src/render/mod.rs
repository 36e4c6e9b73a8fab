//! Rendering: how a pixel gets its colour.

pub mod clay;
pub mod film;
pub mod frame;
pub mod offset;
pub mod path_log;
pub mod path_steps;
pub mod rectangles;
pub mod renderer;
pub mod sphere_light;
pub mod tracer;

pub use protocol::sampler;
