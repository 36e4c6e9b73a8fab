//! Tests of the real program: its access rules, its pictures, and the information it shows about
//! submissions.

mod access;
mod accessibility;
mod browser;
mod expected_tests;
mod explanations;
mod failures;
mod harness;
mod hostile;
mod pictures;
mod questions;
