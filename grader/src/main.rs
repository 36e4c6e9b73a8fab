//! `cargo grade`: one submission, one score.

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use grader::cli::Arguments;
use grader::desktop;
use grader::doctor::examine_machine;
use grader::error::Error;
use grader::grade::grade;
use grader::policy;
use grader::replay::replay;
use grader::report::text::{Hints, report};
use grader::sandbox;
use grader::score::Score;
use grader::watch::watch;

fn main() -> ExitCode {
    if let Some(ended) = sandbox::launched() {
        return ended;
    }
    let arguments = Arguments::parse();
    run(&arguments).unwrap_or_else(|error| {
        anstream::eprintln!("error: {error}");
        ExitCode::from(error.exit_code())
    })
}

fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    if arguments.schema {
        anstream::println!("{:#}", Score::schema().as_value());
        return Ok(ExitCode::SUCCESS);
    }
    if arguments.policy_default {
        anstream::print!("{}", policy::DEFAULT);
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(place) = &arguments.replay {
        anstream::print!("{}", replay(arguments, place)?);
        return Ok(ExitCode::SUCCESS);
    }
    if arguments.doctor {
        let diagnosis = examine_machine()?;
        anstream::print!("{diagnosis}");
        return Ok(ExitCode::from(diagnosis.exit_code()));
    }
    let hints = match arguments.hints {
        true => Hints::Full,
        false => Hints::Nudge,
    };
    if arguments.watch {
        let never = watch(arguments, hints)?;
        match never {}
    }
    let graded = grade(arguments)?;
    anstream::print!("{}", report(&graded.score, arguments.task, hints));
    if let Some(counted) = graded.counted {
        anstream::println!("  counts for {counted}\n");
    }
    if let Some(files) = &graded.files {
        for file in [&files.score, &files.page] {
            anstream::println!("  {}", from_here(file).display());
        }
        if arguments.open {
            desktop::show(&files.page);
        }
    }
    anstream::println!();
    let required = arguments.require.unwrap_or(0);
    Ok(if graded.score.points < required {
        ExitCode::from(1)
    } else {
        ExitCode::SUCCESS
    })
}

/// The path as it would be typed from the current folder.
fn from_here(path: &Path) -> &Path {
    let here = std::env::current_dir().unwrap_or_default();
    path.strip_prefix(here).unwrap_or(path)
}
