//! The program `cargo author`, which writes every generated file and tests the exam.
//! `cargo author --help` lists all commands.

use std::process::ExitCode;

use author::authoring::ASSIGNMENTS;
use author::cli::Cli;
use author::commands;
use clap::Parser;
use grader::printing::print_error;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let authoring = cli.assignment.unwrap_or(ASSIGNMENTS[0]);
    match commands::run(cli.command, authoring) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            print_error(&error);
            ExitCode::FAILURE
        }
    }
}
