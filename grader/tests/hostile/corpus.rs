//! Runs the entries one after the other and prints a summary.

use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};

use grader::handed_out::ASSIGNMENTS;
use grader::sandbox::Isolation;

use crate::canary::Canaries;
use crate::check::{Violation, ViolationKind, violations};
use crate::container;
use crate::entry::Entry;
use crate::run::{self, GraderRun};
use crate::syscalls;
use crate::system_state::SystemState;

/// The entries and levels selected on the command line.
struct Selection {
    all: bool,
    contained: bool,
    levels: Vec<Isolation>,
    names: Vec<String>,
}

impl Selection {
    /// Reads the command line. Flags of the standard test harness are ignored.
    fn from_arguments() -> Self {
        let arguments: Vec<String> = std::env::args().skip(1).collect();
        let (flags, names): (Vec<String>, _) = arguments
            .into_iter()
            .partition(|word| word.starts_with("--"));
        let has = |flag: &str| flags.iter().any(|word| word == flag);
        let levels = Isolation::ALL.into_iter();
        Selection {
            all: has("--all"),
            contained: has("--contained"),
            levels: levels.filter(|level| has(&format!("--{level}"))).collect(),
            names,
        }
    }

    fn includes(&self, entry: &Entry) -> bool {
        if self.names.is_empty() {
            self.all || !entry.expect.slow
        } else {
            self.names.iter().any(|name| entry.name.contains(name))
        }
    }
}

#[derive(Default)]
struct Tally {
    held: usize,
    forged: usize,
    leaked: usize,
    left_behind: usize,
}

pub fn main() -> ExitCode {
    let mut selection = Selection::from_arguments();
    run::become_subreaper();
    if selection.contained {
        container::enter();
    }
    if selection.levels.is_empty() {
        selection.levels.push(best_level());
    }
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hostile");
    let entries = Entry::all(&corpus.join("entries"));
    assert_listed(&entries, &corpus.join("README.md"));
    let entries: Vec<Entry> = entries
        .into_iter()
        .filter(|entry| selection.includes(entry))
        .collect();
    let held = selection
        .levels
        .iter()
        .map(|level| run_at_level(&entries, *level));
    // Collect the results first, so that every level is run even if an earlier one fails.
    if !held.collect::<Vec<bool>>().contains(&false) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// Checks that README.md lists every entry, since it is meant to be a complete list of attacks.
fn assert_listed(entries: &[Entry], list: &Path) {
    let list = fs::read_to_string(list).expect("README.md can be read");
    for entry in entries {
        let (name, _) = entry.name.split_once(" in ").unwrap_or((&entry.name, ""));
        let listed = list.contains(&format!("`{name}`"));
        assert!(listed, "{name} is not in README.md");
    }
}

/// Runs all entries at one level. Returns whether the grader withstood all of them.
fn run_at_level(entries: &[Entry], level: Isolation) -> bool {
    // The first runs compile the dependencies and the references' parts that all later runs share.
    for handed_out in ASSIGNMENTS {
        run::grade(&Entry::reference(handed_out), &Canaries::plant(), level);
    }
    let reference = Entry::reference(ASSIGNMENTS[0]);
    let first = match grade_and_check(&reference, None, level) {
        Ok(run) => run,
        Err(violations) => {
            print_result("BROKEN", &reference, &violations);
            return false;
        }
    };
    let (here, below): (Vec<&Entry>, Vec<&Entry>) = entries
        .iter()
        .partition(|entry| entry.expect.least <= level);
    let mut tally = Tally::default();
    for entry in &here {
        let own = grade_and_check(entry, None, level);
        // This also runs if a check of the entry failed, to find out whether the entry affects the
        // next submission.
        let next = grade_and_check(&reference, Some(&first), level);
        let violations: Vec<Violation> = [own, next]
            .into_iter()
            .filter_map(Result::err)
            .flatten()
            .collect();
        tally.count(&violations);
        let verdict = if violations.is_empty() {
            "held"
        } else {
            "BROKEN"
        };
        print_result(verdict, entry, &violations);
    }
    println!(
        "{level}: {} of {} hostile entries held, {} forged, {} leaked, {} left something behind; {} need stronger isolation",
        tally.held,
        here.len(),
        tally.forged,
        tally.leaked,
        tally.left_behind,
        below.len(),
    );
    tally.held == here.len() && forbidden_calls_fail(level)
}

/// Returns whether all forbidden system calls are refused.
fn forbidden_calls_fail(level: Isolation) -> bool {
    if level == Isolation::None {
        return true;
    }
    let allowed = syscalls::allowed_calls(level);
    println!("{level}: system calls that got through: {allowed:?}");
    allowed.is_empty()
}

fn print_result(verdict: &str, entry: &Entry, violations: &[Violation]) {
    /// The maximum number of violations to print for an entry.
    const MOST: usize = 10;
    println!("{verdict:>6}  {}: {}", entry.name, entry.expect.does);
    // Leftovers come last: the other violations often explain them.
    let (left, others): (Vec<_>, Vec<_>) = violations
        .iter()
        .partition(|violation| violation.kind == ViolationKind::LeftBehind);
    for violation in others.into_iter().chain(left).take(MOST) {
        println!("        {:?}: {}", violation.kind, violation.what);
    }
}

impl Tally {
    fn count(&mut self, violations: &[Violation]) {
        let has = |kind| usize::from(violations.iter().any(|violation| violation.kind == kind));
        self.held += usize::from(violations.is_empty());
        self.forged += has(ViolationKind::Forged);
        self.leaked += has(ViolationKind::Leaked);
        self.left_behind += has(ViolationKind::LeftBehind);
    }
}

/// Grades one entry. Returns the run, or the violations found by the checks. If there is a
/// `baseline`, the score must equal the baseline's.
fn grade_and_check(
    entry: &Entry,
    baseline: Option<&GraderRun>,
    level: Isolation,
) -> Result<GraderRun, Vec<Violation>> {
    let canaries = Canaries::plant();
    let before = SystemState::snapshot(&canaries);
    let run = run::grade(entry, &canaries, level);
    let after = SystemState::snapshot(&canaries);
    let violations = violations(entry, &run, baseline, &canaries, before.differences(&after));
    if violations.is_empty() {
        Ok(run)
    } else {
        Err(violations)
    }
}

/// Returns the best isolation level that works here according to `--doctor`. If none works, returns
/// [`Isolation::None`], or panics if `CI` is set.
fn best_level() -> Isolation {
    let output = Command::new(env!("CARGO_BIN_EXE_grader"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .arg("--doctor")
        .output()
        .expect("the grader starts");
    let report = String::from_utf8_lossy(&output.stdout);
    let works = |level: &Isolation| {
        let mut lines = report.lines().map(str::split_whitespace);
        lines.any(|mut words| words.next() == Some(level.name()) && words.next() == Some("works"))
    };
    let best = Isolation::ALL
        .into_iter()
        .find(works)
        .unwrap_or(Isolation::None);
    if best == Isolation::None {
        assert!(
            std::env::var_os("CI").is_none(),
            "no isolation here:\n{report}"
        );
        eprintln!("SKIPPED: entries that need a sandbox, since there is none here:\n{report}");
    }
    best
}
