//! The corpus of hostile submissions: each is graded by the real binary, with an honest one before
//! and after it, and afterwards nothing may be forged, leaked or left.
//!
//! ```text
//! cargo test -p grader --test hostile                  the quick ones
//! cargo test -p grader --test hostile -- --all         all of them: bombs take minutes
//! cargo test -p grader --test hostile -- C02 flood     those with such names
//! ... -- --full --seccomp-only                         at these levels, not at the best one here
//! ... -- --contained                                   as in a container: no namespaces, no mounts
//! ```
//!
//! What each does, and what may come of it, stands in its folder: `entries/ID-NAME/expect.toml`. Which
//! ideas there are, and where each is tried: `README.md`.

#[cfg(target_os = "linux")]
mod canary;
#[cfg(target_os = "linux")]
mod check;
#[cfg(target_os = "linux")]
mod container;
#[cfg(target_os = "linux")]
mod corpus;
#[cfg(target_os = "linux")]
mod entry;
#[cfg(target_os = "linux")]
mod levels;
#[cfg(target_os = "linux")]
mod packaging;
#[cfg(target_os = "linux")]
mod run;
#[cfg(target_os = "linux")]
mod syscalls;
#[cfg(target_os = "linux")]
mod system_state;

use std::process::ExitCode;

#[cfg(target_os = "linux")]
fn main() -> ExitCode {
    corpus::main()
}

/// What is left of a process is only known where `/proc` tells it.
#[cfg(not(target_os = "linux"))]
fn main() -> ExitCode {
    eprintln!("SKIPPED: the hostile corpus needs Linux");
    ExitCode::SUCCESS
}
