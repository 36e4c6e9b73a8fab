//! Renders a scene with your code: `cargo render scenes/cornell-box.json`.

use std::process::ExitCode;

// solution
// starter: use student::world::Student;
use reference::world::Student;
// end solution

fn main() -> ExitCode {
    framework::harness::cli::main(&Student)
}
