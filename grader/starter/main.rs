//! Renders a scene with your code: `cargo render scenes/cornell-box.json`.

use std::process::ExitCode;

use student::world::Student;

fn main() -> ExitCode {
    framework::harness::cli::main(&Student)
}
