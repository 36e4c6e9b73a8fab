//! The main job: from what a platform gave out to a class's scores.

use std::env;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::thread;

use clap::Parser;
use grader::cli::Arguments;
use grader::error::Error as GraderError;
use grader::grade::Grader;
use grader::policy::PolicyError;
use grader::workspace::Workspace;

use crate::cli::{ClassArguments, Grading, Lists};
use crate::drift::{Drift, drift};
use crate::entry::{About, Entry, Person};
use crate::error::Error;
use crate::groups;
use crate::input::Input;
use crate::layout::{Layout, OF_CLASSROOM50};
use crate::model::{Class, Line};
use crate::outcome::Row;
use crate::progress::Progress;
use crate::queue;
use crate::report::preview::{doubts, preview};
use crate::roster;
use crate::run::{Run, Settings};
use crate::shard::Shard;
use crate::store::Store;
use crate::work::Work;
use crate::written::{Regraded, check, write};

/// Whether all of a class has been graded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// All that could be.
    All,
    /// Not all, for reasons of ours or the machine's.
    NotAll,
}

/// Finds out who handed in what, grades what is missing, writes what the class is told by.
pub fn class(arguments: &ClassArguments) -> Result<Done, Error> {
    check(&arguments.lists)?;
    let workspace = Workspace::find().map_err(GraderError::from)?;
    let named = arguments.input.as_deref().unwrap_or(Path::new("."));
    let input = Input::open(named, &workspace.grade().join("classes"))?;
    let mut found = input.found.clone();
    let people = found.entries.iter_mut();
    let mut people: Vec<&mut Person> = people.flat_map(|entry| &mut entry.about.people).collect();
    let lists = lists(&input, &arguments.lists);
    let mut missing = roster::join(&lists, &mut people)?;
    let entries = found.entries.iter_mut();
    let mut abouts: Vec<&mut About> = entries.map(|entry| &mut entry.about).collect();
    groups::complete(&lists, &mut abouts, &mut missing)?;
    roster::date(&lists, &mut abouts)?;
    let (Some(out), false) = (&arguments.out, arguments.dry_run) else {
        anstream::print!("{}", preview(&found, &missing));
        return Ok(Done::All);
    };

    let words = arguments.grading.arguments();
    let words = Arguments::try_parse_from(words).map_err(Error::Arguments)?;
    let grader = Grader::for_many(&words)?;
    let store = Store::at(out);
    let settings = settings(&grader, &arguments.grading)?;
    let policy = policy_text(&arguments.grading)?;
    if store.run()?.is_some_and(|run| run.policy != policy) {
        anstream::eprintln!(
            "the policy is not that of the last run: points count for other things"
        );
    }
    let run = Run {
        shard: arguments.shard,
        policy,
        ..begun(&store, settings, arguments.regrade)?
    };
    store.sweep()?;
    store.set_run(&run)?;
    let doubts = doubts(&found);
    let entries = arguments.shard.unwrap_or(Shard::ALL).of(found.entries);
    let rows = graded(&grader, &store, &run, &entries, slots(arguments.jobs))?;
    let run = Run {
        finished: true,
        was_finished: true,
        ..run
    };
    store.set_run(&run)?;

    let regraded = regraded(&store, &run, &rows);
    let lines = rows.into_iter().map(|row| Line::of(row, grader.policy()));
    let class = Class {
        exam: run.settings.exam.clone(),
        exam_hash: run.settings.exam_hash.clone(),
        isolation: run.settings.isolation.clone(),
        lines: lines.collect(),
        missing,
    };
    anstream::print!("{doubts}");
    write(&class, &store, &arguments.lists, regraded.as_ref())?;
    Ok(match class.faults() {
        0 => Done::All,
        _ => Done::NotAll,
    })
}

/// Those that are named; where no roster is, classroom50's own, which lies beside its clones.
fn lists(input: &Input, named: &Lists) -> Lists {
    let own = match input.found.layout {
        Layout::GitHub => input.root.find(OF_CLASSROOM50),
        Layout::Gradescope | Layout::Canvas | Layout::Moodle | Layout::Plain => None,
    };
    let roster = named.roster.clone().or(own.map(|node| node.path.clone()));
    Lists {
        roster,
        ..named.clone()
    }
}

/// What all scores follow from, beside the submissions.
fn settings(grader: &Grader, grading: &Grading) -> Result<Settings, Error> {
    let exam = grader.exam_name();
    // The very program: whatever is changed in it, even by a compiler, may change a score.
    let program = env::current_exe().and_then(fs::read);
    let program = program.map_err(GraderError::Probe)?;
    Ok(Settings {
        exam: exam.id.clone(),
        exam_hash: exam.hash.clone(),
        grader: blake2b_simd::blake2b(&program).to_hex()[..32].to_owned(),
        built_with: grader.built_with(),
        isolation: grader.isolation().to_string(),
        options: format!(
            "cpu_limit={:?} no_reference={}",
            grading.cpu_limit, grading.no_reference
        ),
    })
}

/// As it stands in its file, which has been read and understood.
fn policy_text(grading: &Grading) -> Result<Option<String>, PolicyError> {
    let read = |path: &PathBuf| {
        fs::read_to_string(path).map_err(|source| PolicyError::Io {
            path: path.clone(),
            source,
        })
    };
    grading.policy.as_ref().map(read).transpose()
}

/// The run that this one goes on with, or begins. Scores that follow from something else are never
/// mixed with those there are, and never thrown away unasked.
fn begun(store: &Store, settings: Settings, regrade: bool) -> Result<Run, Error> {
    let run = match (store.run()?, regrade) {
        (None, true) => return Err(Error::NothingToRegrade(store.folder().to_owned())),
        (None, false) => Run::first(settings),
        // A regrade that was stopped goes on, whichever way it is called.
        (Some(run), _) if run.settings == settings && (!regrade || !run.finished) => Run {
            finished: false,
            ..run
        },
        (Some(run), true) => {
            // Of a regrade that was given up, some scores are here: the old ones are those that count.
            if !run.is_begun_regrade() {
                store.keep_previous()?;
            }
            run.next(settings)
        }
        (Some(run), false) => {
            return Err(Error::Other {
                out: store.folder().to_owned(),
                what: run.settings.differences(&settings),
            });
        }
    };
    Ok(run)
}

fn graded(
    grader: &Grader,
    store: &Store,
    run: &Run,
    entries: &[Entry],
    slots: usize,
) -> Result<Vec<Row>, Error> {
    let progress = Progress::of(entries.len(), slots);
    let work = Work {
        grader,
        store,
        run,
        progress: &progress,
    };
    let rows = queue::run(entries, slots, |slot, entry| work.row(slot, entry));
    progress.close();
    let rows: Result<Vec<Row>, _> = rows.into_iter().collect();
    Ok(rows?)
}

fn slots(jobs: Option<u16>) -> usize {
    let cores = || thread::available_parallelism().map_or(1, NonZero::get);
    jobs.map_or_else(cores, usize::from)
}

/// What a regrade has changed. None in a folder's first round.
fn regraded(store: &Store, run: &Run, rows: &[Row]) -> Option<Regraded> {
    let before = run.before.as_ref()?;
    let drift = |row: &Row| -> Option<Drift> {
        let was = store.previous(&row.id)?;
        drift(&row.id, &was, row.score())
    };
    Some(Regraded {
        drifts: rows.iter().filter_map(drift).collect(),
        because: before.differences(&run.settings),
    })
}
