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

use crate::cli::{ClassArguments, GradingOptions, Lists};
use crate::drift::{Drift, compare_scores};
use crate::entry::{Entry, EntryInfo, Person};
use crate::entry_grader::EntryGrader;
use crate::error::Error;
use crate::groups;
use crate::input::Input;
use crate::layout::{CLASSROOM50_SCORES, Layout};
use crate::model::{ClassRow, GradedClass};
use crate::outcome::EntryResult;
use crate::output::{RegradeChanges, check_lists, write_results};
use crate::progress::Progress;
use crate::queue;
use crate::report::preview::{render_preview, render_warnings};
use crate::roster;
use crate::run::{Run, Settings};
use crate::shard::Shard;
use crate::store::Store;

/// Whether all of a class has been graded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completion {
    /// All that could be.
    Complete,
    /// Not all, for reasons of ours or the machine's.
    Incomplete,
}

/// Finds out who handed in what, grades what is missing, writes what the class is told by.
pub fn grade_class(arguments: &ClassArguments) -> Result<Completion, Error> {
    check_lists(&arguments.lists)?;
    let workspace = Workspace::find().map_err(GraderError::from)?;
    let named = arguments.input.as_deref().unwrap_or(Path::new("."));
    let input = Input::open(named, &workspace.output_folder().join("classes"))?;
    let mut found = input.class.clone();
    let people = found.entries.iter_mut();
    let mut people: Vec<&mut Person> = people.flat_map(|entry| &mut entry.info.people).collect();
    let lists = resolve_lists(&input, &arguments.lists);
    let mut missing = roster::join(&lists, &mut people)?;
    let entries = found.entries.iter_mut();
    let mut abouts: Vec<&mut EntryInfo> = entries.map(|entry| &mut entry.info).collect();
    groups::add_group_members(&lists, &mut abouts, &mut missing)?;
    roster::set_submission_times(&lists, &mut abouts)?;
    let (Some(out), false) = (&arguments.out, arguments.dry_run) else {
        anstream::print!("{}", render_preview(&found, &missing));
        return Ok(Completion::Complete);
    };

    let words = arguments.grading.to_arguments();
    let words = Arguments::try_parse_from(words).map_err(Error::Arguments)?;
    let grader = Grader::for_many(&words)?;
    let store = Store::new(out);
    let settings = settings(&grader, &arguments.grading)?;
    let policy = policy_text(&arguments.grading)?;
    if store.read_run()?.is_some_and(|run| run.policy != policy) {
        anstream::eprintln!(
            "the policy is not that of the last run: points count for other things"
        );
    }
    let run = Run {
        shard: arguments.shard,
        policy,
        ..start_or_resume(&store, settings, arguments.regrade)?
    };
    store.remove_temporary_files()?;
    store.write_run(&run)?;
    let doubts = render_warnings(&found);
    let entries = arguments.shard.unwrap_or(Shard::ALL).select(found.entries);
    let rows = grade_entries(&grader, &store, &run, &entries, slot_count(arguments.jobs))?;
    let run = Run {
        finished: true,
        was_finished: true,
        ..run
    };
    store.write_run(&run)?;

    let regraded = find_regrade_changes(&store, &run, &rows);
    let lines = rows
        .into_iter()
        .map(|row| ClassRow::new(row, grader.policy()));
    let class = GradedClass {
        exam: run.settings.exam.clone(),
        exam_hash: run.settings.exam_hash.clone(),
        isolation: run.settings.isolation.clone(),
        rows: lines.collect(),
        missing,
    };
    anstream::print!("{doubts}");
    write_results(&class, &store, &arguments.lists, regraded.as_ref())?;
    Ok(match class.fault_count() {
        0 => Completion::Complete,
        _ => Completion::Incomplete,
    })
}

/// Those that are named; where no roster is, classroom50's own, which lies beside its clones.
fn resolve_lists(input: &Input, named: &Lists) -> Lists {
    let own = match input.class.layout {
        Layout::GitHub => input.root.find(CLASSROOM50_SCORES),
        Layout::Gradescope | Layout::Canvas | Layout::Moodle | Layout::Plain => None,
    };
    let roster = named.roster.clone().or(own.map(|node| node.path.clone()));
    Lists {
        roster,
        ..named.clone()
    }
}

/// What all scores follow from, beside the submissions.
fn settings(grader: &Grader, grading: &GradingOptions) -> Result<Settings, Error> {
    let exam = grader.exam_name();
    // The very program: whatever is changed in it, even by a compiler, may change a score.
    let program = env::current_exe().and_then(fs::read);
    let program = program.map_err(GraderError::Probe)?;
    Ok(Settings {
        exam: exam.id.clone(),
        exam_hash: exam.hash.clone(),
        grader: blake2b_simd::blake2b(&program).to_hex()[..32].to_owned(),
        built_with: grader.builder_identity(),
        isolation: grader.isolation().to_string(),
        options: format!(
            "cpu_limit={:?} no_reference={}",
            grading.cpu_limit, grading.no_reference
        ),
    })
}

/// As it stands in its file, which has been read and understood.
fn policy_text(grading: &GradingOptions) -> Result<Option<String>, PolicyError> {
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
fn start_or_resume(store: &Store, settings: Settings, regrade: bool) -> Result<Run, Error> {
    let run = match (store.read_run()?, regrade) {
        (None, true) => return Err(Error::NothingToRegrade(store.folder().to_owned())),
        (None, false) => Run::first_round(settings),
        // A regrade that was stopped goes on, whichever way it is called.
        (Some(run), _) if run.settings == settings && (!regrade || !run.finished) => Run {
            finished: false,
            ..run
        },
        (Some(run), true) => {
            // Of a regrade that was given up, some scores are here: the old ones are those that count.
            if !run.is_unfinished_regrade() {
                store.save_previous_scores()?;
            }
            run.next_round(settings)
        }
        (Some(run), false) => {
            return Err(Error::SettingsChanged {
                out: store.folder().to_owned(),
                differences: run.settings.differences(&settings),
            });
        }
    };
    Ok(run)
}

fn grade_entries(
    grader: &Grader,
    store: &Store,
    run: &Run,
    entries: &[Entry],
    slots: usize,
) -> Result<Vec<EntryResult>, Error> {
    let progress = Progress::new(entries.len(), slots);
    let work = EntryGrader {
        grader,
        store,
        run,
        progress: &progress,
    };
    let rows = queue::run(entries, slots, |slot, entry| work.grade(slot, entry));
    progress.finish();
    let rows: Result<Vec<EntryResult>, _> = rows.into_iter().collect();
    Ok(rows?)
}

fn slot_count(jobs: Option<u16>) -> usize {
    let cores = || thread::available_parallelism().map_or(1, NonZero::get);
    jobs.map_or_else(cores, usize::from)
}

/// What a regrade has changed. None in a folder's first round.
fn find_regrade_changes(store: &Store, run: &Run, rows: &[EntryResult]) -> Option<RegradeChanges> {
    let before = run.before.as_ref()?;
    let drift = |row: &EntryResult| -> Option<Drift> {
        let was = store.previous_score(&row.id)?;
        compare_scores(&row.id, &was, row.score())
    };
    Some(RegradeChanges {
        drifts: rows.iter().filter_map(drift).collect(),
        causes: before.differences(&run.settings),
    })
}
