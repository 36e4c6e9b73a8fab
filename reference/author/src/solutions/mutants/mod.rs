//! The mutants that cargo-mutants makes of the reference's task files.
//!
//! Mutants complement the catalogue of mistakes. The catalogue lists mistakes that people make;
//! mutants are generated without any knowledge of the exam.

pub mod cargo_mutants;
pub mod equivalent;
pub mod list;
pub mod span;
