//! The corpus of hostile submissions. Each one is graded by the real program, with a correct
//! submission before and after it. Nothing may be forged, leaked or left behind.
//!
//! ```text
//! cargo test -p grader --test hostile                runs the quick entries
//! cargo test -p grader --test hostile -- --all       runs all entries: bombs take minutes
//! cargo test -p grader --test hostile -- C02 flood   runs entries whose names contain these
//! ... -- --full --no-namespaces                      at these isolation levels (default: the best)
//! ... -- --contained                                 as in a container: no namespaces, no mounts
//! ```
//!
//! TOML describes each entry and its permitted results: at the beginning of `entries/ID-NAME.rs`,
//! in `expect.toml` next to several files, or in `packaged.toml`. `README.md` lists all known
//! attacks and where each is tested.

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

/// Skips the corpus, because leftover processes cannot be found without `/proc`.
#[cfg(not(target_os = "linux"))]
fn main() -> ExitCode {
    eprintln!("SKIPPED: the hostile corpus needs Linux");
    ExitCode::SUCCESS
}
