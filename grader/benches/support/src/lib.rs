//! The parts that the benchmarks of the grader and of a class share. `grader/benches/README.md`
//! explains what they measure.
//!
//! On Unix only, like the benchmarks: elsewhere there is no CPU time of child processes.

#![cfg(unix)]

pub mod bare;
pub mod changed;
pub mod cost;
pub mod median;
pub mod short_form;
