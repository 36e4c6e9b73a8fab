//! Tests that run the real binary on real submissions. Each module tests one promise to users. Each
//! folder in `tests/submissions` is one submission, and contains only the files that differ from
//! the reference.

mod bad_exams;
mod bad_submissions;
mod cached_report;
mod command_line;
mod dependencies;
mod faults;
mod formats;
mod harness;
mod hints;
#[cfg(target_os = "linux")]
mod isolation;
mod language;
#[cfg(target_os = "linux")]
mod ordinary_user;
mod packages;
mod policies;
mod scores;
mod substitution;
mod watch;
