//! Reports for people and programs, rendered from a score.

pub mod answers;
pub mod atomic_write;
mod failing_items;
pub mod html;
pub mod next_step;
pub mod text;
