//! `cargo grade`: one submission, one score.

use std::io;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use grader::cli::Arguments;
use grader::desktop;
use grader::doctor::{examine_machine, package};
use grader::earlier;
use grader::error::Error;
use grader::files::Files;
use grader::format::github;
use grader::grade::{Graded, grade};
use grader::policy;
use grader::replay::replay;
use grader::report::text::{Hints, report};
use grader::sandbox;
use grader::score;
use grader::unchanged;
use grader::watch::watch;

/// Said of what was not graded once more.
const UNCHANGED: &str =
    "  Nothing has changed since this was graded; `--fresh` grades it once more.\n\n";

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
        anstream::print!("{}", score::PUBLISHED);
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
    if let Some(package) = &arguments.package {
        let complaints = package::complaints(package)?;
        for complaint in &complaints {
            anstream::println!("{}: {complaint}", package.display());
        }
        return Ok(match complaints.len() {
            0 => {
                anstream::println!("{}: nothing is wrong with it", package.display());
                ExitCode::SUCCESS
            }
            _ => ExitCode::from(2),
        });
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
    if let Some((earlier, files)) = unchanged::find(arguments)? {
        tell(&format!("{}{UNCHANGED}{}", earlier.told, places(&files)))?;
        if arguments.open {
            desktop::show(&files.page);
        }
        return Ok(enough(earlier.points, arguments));
    }
    let graded = grade(arguments)?;
    let told = told(&graded, arguments, hints);
    tell(&format!(
        "{told}{}",
        graded.files.as_ref().map_or(String::new(), places)
    ))?;
    if let (Some(key), Some(files)) = (&graded.key, &graded.files) {
        earlier::keep(key, &graded.score, &told, files);
    }
    if let Some(commands) = graded.commands() {
        anstream::print!("{commands}");
    }
    if let Some(files) = graded.files.as_ref().filter(|_| arguments.open) {
        desktop::show(&files.page);
    }
    if arguments.timings {
        anstream::println!("{}", graded.score.timings.stages.table());
    }
    Ok(enough(graded.score.points, arguments))
}

/// Whether that many points are as many as required.
fn enough(points: u32, arguments: &Arguments) -> ExitCode {
    match points < arguments.require.unwrap_or(0) {
        true => ExitCode::from(1),
        false => ExitCode::SUCCESS,
    }
}

/// What is read on a terminal. With a platform's format, students read it in a log.
fn told(graded: &Graded, arguments: &Arguments, hints: Hints) -> String {
    let score = match arguments.format.is_empty() {
        true => &graded.score,
        false => &graded.seen.now,
    };
    let mut told = report(score, arguments.task, hints);
    if arguments.policy.is_some() && arguments.task.is_none() {
        told.push_str(&format!("  counts for {}\n\n", graded.seen.counted));
    }
    told
}

/// The files that tell it, a line each.
fn places(files: &Files) -> String {
    let lines = files.paths().map(from_here);
    lines
        .map(|file| format!("  {}\n", file.display()))
        .collect()
}

/// Prints it. Where a runner looks for commands in all that is printed, it is told not to.
fn tell(text: &str) -> Result<(), Error> {
    match std::env::var_os("GITHUB_ACTIONS") {
        Some(_) => {
            let token = github::token().map_err(io::Error::other)?;
            anstream::println!("{}", github::silenced(text, &token));
        }
        None => anstream::println!("{text}"),
    }
    Ok(())
}

/// The path as it would be typed from the current folder.
fn from_here(path: &Path) -> &Path {
    let here = std::env::current_dir().unwrap_or_default();
    path.strip_prefix(here).unwrap_or(path)
}
