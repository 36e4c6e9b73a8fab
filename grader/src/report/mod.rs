//! Reports for people and programs, rendered from a score.

pub mod atomic_write;
pub mod html;
pub mod json;
pub mod next_step;
mod shared_hints;
pub mod text;
