//! `cargo class`: grades a class in one command. A killed run can be resumed.

use std::process::ExitCode;

use clap::Parser;
use class::cli::{Cli, Command};
use class::error::Error;
use class::grade::{Completion, grade_class};
use class::merge::merge_shards;
use class::replay::replay_question;
use grader::printing::{exit_with, print, print_error};
use grader::sandbox;

fn main() -> ExitCode {
    if let Some(ended) = sandbox::run_as_launcher() {
        return ended;
    }
    let cli = Cli::try_parse().unwrap_or_else(|error| exit_with(&error));
    match run(&cli) {
        Ok(Completion::Complete) => ExitCode::SUCCESS,
        Ok(Completion::Incomplete) => ExitCode::from(3),
        Err(error) => {
            print_error(&error);
            ExitCode::from(error.exit_code)
        }
    }
}

fn run(cli: &Cli) -> Result<Completion, Error> {
    match &cli.command {
        Some(Command::Merge(arguments)) => {
            merge_shards(arguments, arguments.assignment.unwrap_or_default())
        }
        None => {
            let options = cli.class.grading.resolve();
            match (&cli.class.replay, &cli.class.out) {
                (Some(question), Some(out)) => {
                    print(replay_question(out, question, &options)?);
                    Ok(Completion::Complete)
                }
                _ => grade_class(&cli.class, &options),
            }
        }
    }
}
