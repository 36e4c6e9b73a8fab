//! `cargo handin`: makes the archive to hand in.

use std::process::ExitCode;

use clap::Parser;
use grader::hand_in::{HandIn, HandInArguments};
use grader::printing::{exit_with, print, print_error};

fn main() -> ExitCode {
    let arguments = HandInArguments::try_parse().unwrap_or_else(|error| exit_with(&error));
    match HandIn::make(arguments) {
        Ok(made) => {
            print(&made);
            ExitCode::from(u8::from(!made.is_ready()))
        }
        Err(error) => {
            print_error(&error);
            ExitCode::from(error.exit_code())
        }
    }
}
