//! Tests that the exam catches every known mistake and gives full marks to correct code, by grading
//! many solutions.
//!
//! `reference/mistakes` contains known mistakes, which are small changes to the reference,
//! `reference/variants` contains other correct solutions, and `reference/mutants` lists mechanical
//! changes to the reference. Each solution is built and graded like any submission.

pub mod calibrate;
pub mod catalogue;
pub mod graded_mistake;
pub mod matrix;
pub mod mutants;
pub mod prove;
pub mod recognition;
pub mod solutions;
pub mod sources;
pub mod summary;
pub mod variants;
pub mod workbench;
