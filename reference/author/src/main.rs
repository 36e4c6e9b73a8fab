//! The program `cargo author`: writes every generated file, and tests the exam. Its option `--help`
//! lists all commands.

use std::process::ExitCode;

use author::cli::Cli;
use author::commands;
use clap::Parser;
use grader::printing::print_error;

fn main() -> ExitCode {
    match commands::run(Cli::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            print_error(&error);
            ExitCode::FAILURE
        }
    }
}
