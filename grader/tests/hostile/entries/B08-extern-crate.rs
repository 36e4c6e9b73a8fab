//! does = "It uses crates that would know the correct answers."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//!
//! [points]
//! sphere = 0

extern crate grader;
extern crate parts;
extern crate reference;
