//! Renders a scene in clay with this part alone: `cargo run --release --package student --
//! cornell-box`. `cargo render` also needs part two, in `light`, and shows its light.

use std::process::ExitCode;

// solution
// starter: use student::world::Student;
use reference::world::Student;
// end solution

fn main() -> ExitCode {
    framework::harness::cli::main(&Student, None)
}
