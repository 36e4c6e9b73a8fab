//! That the exam catches every known mistake and fails no honest answer: shown by asking them.
//!
//! `reference/mistakes` holds small wrong changes to the reference, `reference/variants` other
//! right solutions, `reference/mutants` what a program makes of it. Each is built and asked like any
//! submission, through the same pipe.

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
