//! Reports about a class, as text, HTML and CSV.

pub mod grades;
pub mod page;
pub mod preview;
pub mod text;
