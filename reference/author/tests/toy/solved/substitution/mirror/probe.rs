//! The probe for a submission's `mirror.rs` that is graded with the reference's `ball.rs`.

use parts::*;

mod mirror;
mod world;

fn main() -> std::process::ExitCode {
    framework::harness::probe::main(&world::Student)
}
