//! `cargo class`: grades a class in one command. A killed run can be resumed.

use std::process::ExitCode;

use clap::Parser;
use class::cli::{Cli, Command};
use class::error::Error;
use class::grade::{Completion, grade_class};
use class::merge::merge_shards;
use grader::sandbox;
use judging::sanitize::sanitize;

fn main() -> ExitCode {
    if let Some(ended) = sandbox::run_as_launcher() {
        return ended;
    }
    match run(&Cli::parse()) {
        Ok(Completion::Complete) => ExitCode::SUCCESS,
        Ok(Completion::Incomplete) => ExitCode::from(3),
        Err(error) => {
            anstream::eprintln!("error: {}", sanitize(&error.to_string(), usize::MAX));
            ExitCode::from(error.exit_code())
        }
    }
}

fn run(cli: &Cli) -> Result<Completion, Error> {
    match &cli.command {
        Some(Command::Merge(arguments)) => merge_shards(arguments),
        None => grade_class(&cli.class, &cli.class.grading.resolve()),
    }
}
