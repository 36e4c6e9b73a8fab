//! Tests that the exam catches every known mistake and gives full marks to correct code, by
//! grading many [solutions](crate::solutions).

pub mod calibrate;
pub mod detections;
pub mod failures;
pub mod grade;
pub mod matrix;
pub mod mutants;
pub mod prove;
pub mod recognition;
mod run;
pub mod summary;
