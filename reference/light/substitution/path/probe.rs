//! The probe for a submission's `path.rs` that is graded with the reference's parts.

use parts::*;

mod exam;
mod path;

fn main() -> std::process::ExitCode {
    framework::harness::probe::main(&exam::Student)
}
