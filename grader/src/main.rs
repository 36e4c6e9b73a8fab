//! `cargo grade`: grades one submission.

use std::io;
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use grader::cache_lookup;
use grader::cached_report;
use grader::cli::Arguments;
use grader::desktop;
use grader::doctor::{diagnose, package};
use grader::error::Error;
use grader::format::github;
use grader::grade::{GradedSubmission, grade};
use grader::policy;
use grader::replay::replay;
use grader::report::text::{HintDetail, report};
use grader::report_files::ReportFiles;
use grader::sandbox;
use grader::score;
use grader::watch::watch;

/// Notice that is printed below a cached report.
const UNCHANGED_NOTICE: &str =
    "  Nothing has changed since this was graded; use `--fresh` to grade it again.\n\n";

fn main() -> ExitCode {
    if let Some(ended) = sandbox::run_as_launcher() {
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
        anstream::print!("{}", score::PUBLISHED_SCHEMA);
        return Ok(ExitCode::SUCCESS);
    }
    if arguments.policy_default {
        anstream::print!("{}", policy::DEFAULT);
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(question) = &arguments.replay {
        anstream::print!("{}", replay(arguments, question)?);
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(package) = &arguments.package {
        let problems = package::problems(package)?;
        for problem in &problems {
            anstream::println!("{}: {problem}", package.display());
        }
        return Ok(match problems.len() {
            0 => {
                anstream::println!("{}: no problems found", package.display());
                ExitCode::SUCCESS
            }
            _ => ExitCode::from(2),
        });
    }
    if arguments.doctor {
        let diagnosis = diagnose()?;
        anstream::print!("{diagnosis}");
        return Ok(ExitCode::from(diagnosis.exit_code()));
    }
    let hints = if arguments.hints {
        HintDetail::Full
    } else {
        HintDetail::Nudge
    };
    if arguments.watch {
        let never = watch(arguments, hints)?;
        match never {}
    }
    if let Some((cached, files)) = cache_lookup::find_cached_report(arguments)? {
        print_text(&format!(
            "{}{UNCHANGED_NOTICE}{}",
            cached.report,
            file_list(&files)
        ))?;
        if arguments.open {
            desktop::show(&files.page);
        }
        return Ok(exit_code(cached.points, arguments));
    }
    let graded = grade(arguments)?;
    let text = terminal_report(&graded, arguments, hints);
    print_text(&format!(
        "{text}{}",
        graded.files.as_ref().map_or(String::new(), file_list)
    ))?;
    if let (Some(key), Some(files)) = (&graded.cache_key, &graded.files) {
        cached_report::store(key, &graded.score, &text, files);
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
    Ok(exit_code(graded.score.points, arguments))
}

/// Returns the exit code for these points: 1 if they are below `--require`.
fn exit_code(points: u32, arguments: &Arguments) -> ExitCode {
    if points < arguments.require.unwrap_or(0) {
        ExitCode::from(1)
    } else {
        ExitCode::SUCCESS
    }
}

/// Returns the report for the terminal. With `--format`, it appears in a log that students read, so
/// it contains only what they may see.
fn terminal_report(graded: &GradedSubmission, arguments: &Arguments, hints: HintDetail) -> String {
    let score = if arguments.format.is_empty() {
        &graded.score
    } else {
        &graded.student_view.visible
    };
    let mut text = report(score, arguments.task, hints);
    if arguments.policy.is_some() && arguments.task.is_none() {
        text.push_str(&format!("  counts for {}\n\n", graded.student_view.counted));
    }
    text
}

/// Returns the paths of the report's files, one per line.
fn file_list(files: &ReportFiles) -> String {
    let lines = files.paths().map(relative_to_current_folder);
    lines
        .map(|file| format!("  {}\n", file.display()))
        .collect()
}

/// Prints the text. On GitHub Actions, where printed text can contain commands to the runner, these
/// are disabled.
fn print_text(text: &str) -> Result<(), Error> {
    match std::env::var_os("GITHUB_ACTIONS") {
        Some(_) => {
            let token = github::random_token().map_err(io::Error::other)?;
            anstream::println!("{}", github::with_commands_stopped(text, &token));
        }
        None => anstream::println!("{text}"),
    }
    Ok(())
}

/// Returns the path relative to the current folder, if it is inside that folder.
fn relative_to_current_folder(path: &Path) -> &Path {
    let here = std::env::current_dir().unwrap_or_default();
    path.strip_prefix(here).unwrap_or(path)
}
