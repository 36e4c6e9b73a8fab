//! All entries, one after the other, and the closing line.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use grader::sandbox::Isolation;

use crate::canary::Canaries;
use crate::check::{Violation, ViolationKind, violations};
use crate::container;
use crate::entry::Entry;
use crate::levels;
use crate::run::{self, GraderRun};
use crate::syscalls;
use crate::system_state::SystemState;

/// What the command line asks for.
struct Selection {
    all: bool,
    contained: bool,
    levels: Vec<Isolation>,
    names: Vec<String>,
}

impl Selection {
    /// Flags of the usual test harness are none of ours, and pass.
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
        match self.names.is_empty() {
            true => self.all || !entry.expect.slow,
            false => self.names.iter().any(|name| entry.name.contains(name)),
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
        selection.levels.push(levels::best_level());
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
    // Every level is tried, also after one that does not hold.
    match held.collect::<Vec<bool>>().contains(&false) {
        false => ExitCode::SUCCESS,
        true => ExitCode::FAILURE,
    }
}

/// An idea that the list of all ideas does not know would be thought to be missing.
fn assert_listed(entries: &[Entry], list: &Path) {
    let list = fs::read_to_string(list).expect("there is a list");
    for entry in entries {
        let listed = list.contains(&format!("`{}`", entry.name));
        assert!(listed, "{} is not in README.md", entry.name);
    }
}

/// Whether all entries hold at one level.
fn run_at_level(entries: &[Entry], level: Isolation) -> bool {
    let honest = Entry::reference();
    // Whatever is compiled once is compiled here.
    run::grade(&honest, &Canaries::plant(), level);
    let first = match grade_and_check(&honest, None, level) {
        Ok(run) => run,
        Err(broken) => {
            print_result("BROKEN", &honest, &broken);
            return false;
        }
    };
    let (here, below): (Vec<&Entry>, Vec<&Entry>) = entries
        .iter()
        .partition(|entry| entry.expect.least <= level);
    let mut tally = Tally::default();
    for entry in &here {
        let own = grade_and_check(entry, None, level);
        // Also after one that went wrong: whether it harms the next is what this is about.
        let next = grade_and_check(&honest, Some(&first), level);
        let broken: Vec<Violation> = [own, next]
            .into_iter()
            .filter_map(Result::err)
            .flatten()
            .collect();
        tally.count(&broken);
        let verdict = if broken.is_empty() { "held" } else { "BROKEN" };
        print_result(verdict, entry, &broken);
    }
    println!(
        "{level}: hostile {} of {} held, forged {}, leaked {}, left {}; {} are for better levels",
        tally.held,
        here.len(),
        tally.forged,
        tally.leaked,
        tally.left_behind,
        below.len(),
    );
    tally.held == here.len() && forbidden_calls_fail(level)
}

/// Whether none of the calls that no submission may make is let through.
fn forbidden_calls_fail(level: Isolation) -> bool {
    if level == Isolation::None {
        return true;
    }
    let open = syscalls::allowed_calls(level);
    println!("{level}: system calls let through: {open:?}");
    open.is_empty()
}

fn print_result(verdict: &str, entry: &Entry, broken: &[Violation]) {
    /// The most findings of one entry that are told.
    const MOST: usize = 10;
    println!("{verdict:>6}  {}: {}", entry.name, entry.expect.does);
    // What is left is often for a reason that is told as well.
    let (left, others): (Vec<_>, Vec<_>) = broken
        .iter()
        .partition(|broken| broken.kind == ViolationKind::LeftBehind);
    for broken in others.into_iter().chain(left).take(MOST) {
        println!("        {:?}: {}", broken.kind, broken.what);
    }
}

impl Tally {
    fn count(&mut self, broken: &[Violation]) {
        let has = |finding| usize::from(broken.iter().any(|broken| broken.kind == finding));
        self.held += usize::from(broken.is_empty());
        self.forged += has(ViolationKind::Forged);
        self.leaked += has(ViolationKind::Leaked);
        self.left_behind += has(ViolationKind::LeftBehind);
    }
}

/// Grades one entry and looks at all that it may have done. `as_before`: what an honest one got.
fn grade_and_check(
    entry: &Entry,
    as_before: Option<&GraderRun>,
    level: Isolation,
) -> Result<GraderRun, Vec<Violation>> {
    let canaries = Canaries::plant();
    let before = SystemState::snapshot(&canaries);
    let run = run::grade(entry, &canaries, level);
    let after = SystemState::snapshot(&canaries);
    let broken = violations(
        entry,
        &run,
        as_before,
        &canaries,
        before.differences(&after),
    );
    match broken.is_empty() {
        true => Ok(run),
        false => Err(broken),
    }
}
