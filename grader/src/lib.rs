//! Grades a path-tracing submission.
pub mod exam;
