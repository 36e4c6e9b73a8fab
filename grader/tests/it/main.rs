//! Tests that run the real binary on real submissions, most of which are the reference with a small
//! change. Each module tests one promise made to users.

mod assignments;
mod bad_exams;
mod bad_programs;
mod bad_submissions;
mod cached_report;
mod cases;
mod command_line;
mod dependencies;
mod faults;
mod formats;
mod hand_in;
mod harness;
mod hints;
#[cfg(target_os = "linux")]
mod isolation;
#[cfg(target_os = "linux")]
mod next_steps;
mod ordinary_user;
mod packages;
mod part_two;
mod policies;
mod reset;
#[cfg(unix)]
mod runner_commands;
mod scores;
mod side_by_side;
mod sources;
mod substitution;
mod watch;
#[cfg(unix)]
mod watch_terminal;
