//! Tests of the real program: its access rules, its pictures, and the information it shows about
//! submissions.

mod access;
mod accessibility;
mod browser;
mod expected_tests;
mod explanations;
mod failures;
mod hangs;
mod harness;
mod hostile;
mod layout;
mod mistakes;
mod part_two;
mod pictures;
mod questions;
mod tree_checkup;
