//! Grades a submission.
fn main() {}
