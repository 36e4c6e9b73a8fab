//! Renders a scene with your code for both parts: `cargo render scenes/cornell-box.json`.

use std::process::ExitCode;

// solution
// starter: use light::integrator::Light;
// starter: use student::world::Student;
use reference::world::Student;
use reference_light::integrator::Light;
// end solution

fn main() -> ExitCode {
    framework::harness::cli::main(&Student, Some(&Light))
}
