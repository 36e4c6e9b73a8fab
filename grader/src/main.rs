//! `cargo grade`: grades one submission.

use std::process::ExitCode;

use grader::cli::{Arguments, Command};
use grader::error::Error;
use grader::policy;
use grader::printing::{print, print_error};
use grader::replay::replay;
use grader::reset::reset;
use grader::sandbox;
use grader::score;
use grader::terminal::{diagnose_and_print, grade_and_print, grade_started_and_print};
use grader::watch::watch;

fn main() -> ExitCode {
    if let Some(code) = sandbox::run_as_launcher() {
        return code;
    }
    let command = Arguments::from_command_line().resolve();
    command.and_then(run).unwrap_or_else(|error| {
        print_error(&error);
        ExitCode::from(error.exit_code())
    })
}

fn run(command: Command) -> Result<ExitCode, Error> {
    match command {
        Command::Grade(options, print) => return grade_and_print(&options, print),
        Command::GradeStarted(options, print) => return grade_started_and_print(&options, print),
        Command::Watch { options, open } => match watch(&options, open)? {},
        Command::Replay(options, question) => print(replay(&options, &question)?),
        Command::Reset {
            handed_out,
            folder,
            names,
        } => print(reset(handed_out, folder.as_deref(), &names)?),
        Command::Diagnose => return diagnose_and_print(),
        Command::PrintSchema => print(score::PUBLISHED_SCHEMA),
        Command::PrintDefaultPolicy => print(policy::DEFAULT),
        Command::PrintHelp(help) => print(help.ansi()),
    }
    Ok(ExitCode::SUCCESS)
}
