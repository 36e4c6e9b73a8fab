//! `cargo class`: a class, one command, killed at any time.

use std::process::ExitCode;

use clap::Parser;
use class::class::{Done, class};
use class::cli::{Cli, Command};
use class::error::Error;
use class::merge::merge;
use grader::sandbox;

fn main() -> ExitCode {
    if let Some(ended) = sandbox::launched() {
        return ended;
    }
    match run(&Cli::parse()) {
        Ok(Done::All) => ExitCode::SUCCESS,
        Ok(Done::NotAll) => ExitCode::from(3),
        Err(error) => {
            anstream::eprintln!("error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn run(cli: &Cli) -> Result<Done, Error> {
    match &cli.command {
        Some(Command::Merge(arguments)) => merge(arguments),
        None => class(&cli.class),
    }
}
