//! Runs the worked examples in the task files: `cargo examples sphere`.

use std::process::ExitCode;

fn main() -> ExitCode {
    framework::harness::cli::examples::main()
}
