//! `cargo handin`: makes the archive to hand in.

use std::process::ExitCode;

use clap::Parser;
use grader::hand_in::{HandIn, HandInArguments};
use grader::handed_out::RAYS;
use judging::sanitize::sanitize;

fn main() -> ExitCode {
    match HandIn::make(HandInArguments::parse(), &RAYS) {
        Ok(made) => {
            anstream::print!("{made}");
            ExitCode::from(u8::from(!made.is_ready()))
        }
        Err(error) => {
            anstream::eprintln!("error: {}", sanitize(&error.to_string(), usize::MAX));
            ExitCode::from(error.exit_code())
        }
    }
}
