//! The real binary on real submissions. Each module is one thing that people rely on; each folder
//! in `tests/submissions` is one idea of a submission, as the files in which it differs.

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
#[cfg(target_os = "linux")]
mod ordinary_user;
mod packages;
mod policies;
mod scores;
mod substitution;
mod watch;
