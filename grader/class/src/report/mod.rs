//! What people and programs read of a class: each a function of it.

pub mod grades;
pub mod page;
pub mod preview;
pub mod text;
