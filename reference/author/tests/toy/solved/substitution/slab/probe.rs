//! The probe for a submission's `slab.rs` that is graded with the reference's `ball.rs`.

use parts::ball;

mod slab;
mod world;

fn main() -> std::process::ExitCode {
    framework::harness::probe::main(&world::Student)
}
