//! What people and programs read: each format a function of the score.

pub mod atomic_write;
pub mod html;
pub mod json;
pub mod text;
