//! Tests of the real program: its rules of access, its pictures, and what it shows of submissions.

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
