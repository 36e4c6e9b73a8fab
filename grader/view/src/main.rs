//! `cargo view`: shows a tracer at work.

use std::process::ExitCode;

use clap::Parser;
use grader::printing::{exit_with, print_error};
use grader::sandbox;
use view::cli::Arguments;
use view::run::run;

fn main() -> ExitCode {
    if let Some(code) = sandbox::run_as_launcher() {
        return code;
    }
    let arguments = Arguments::try_parse().unwrap_or_else(|error| exit_with(&error));
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            print_error(&error);
            ExitCode::from(error.exit_code())
        }
    }
}
