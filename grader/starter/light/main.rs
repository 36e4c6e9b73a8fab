//! Renders a scene with your code for both parts: `cargo render scenes/cornell-box.json`.

use std::process::ExitCode;

use light::integrator::Light;
use student::world::Student;

fn main() -> ExitCode {
    framework::harness::cli::main(&Student, Some(&Light))
}
