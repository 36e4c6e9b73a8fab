//! `cargo view`: shows a tracer at work.

use std::process::ExitCode;

use clap::Parser;
use grader::sandbox;
use judging::sanitize::sanitize;
use view::cli::Arguments;
use view::run::run;

fn main() -> ExitCode {
    if let Some(code) = sandbox::run_as_launcher() {
        return code;
    }
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            anstream::eprintln!("error: {}", sanitize(&error.to_string(), usize::MAX));
            ExitCode::from(error.exit_code())
        }
    }
}
