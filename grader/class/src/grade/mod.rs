//! Grades a class: reads a learning platform's export, and writes the files with the scores.

use std::num::NonZero;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use grader::error::Error as GraderError;
use grader::grade::Grader;
use grader::handed_out::HandedOut;
use grader::options::GradeOptions;
use grader::printing::print;
use grader::workspace::Workspace;
use judging::content_hash::file_hash;

use crate::cli::{ClassArguments, Lists};
use crate::entry::{Entry, EntryInfo, Person};
use crate::entry_grader::{EntryGrader, is_done};
use crate::error::Error;
use crate::estimate::Estimate;
use crate::input::Input;
use crate::late::warn_about_extensions;
use crate::layout::{CLASSROOM50_SCORES, Layout};
use crate::list_memory::{KeptIn, ListFiles, UsedLists};
use crate::lists;
use crate::manual_points::ManualPointsList;
use crate::outcome::EntryResult;
use crate::output::{ClassContext, check_lists};
use crate::paths::contains;
use crate::progress::Progress;
use crate::queue;
use crate::regrade_diff::{
    Changes, RegradeChanges, compare_scores, find_removed, find_resubmitted,
};
use crate::report::preview::{render_preview, render_warnings};
use crate::roster;
use crate::run::{RoundState, Run, Settings};
use crate::shard::Shard;
use crate::similarity;
use crate::store::Store;
use crate::submission_grader::SubmissionGrader;

pub use crate::output::Completion;

/// Reads the input, grades the submissions without a valid result, and writes the class's files.
/// Each submission is graded with `options`.
pub fn grade_class(
    arguments: &ClassArguments,
    options: &GradeOptions,
) -> Result<Completion, Error> {
    let prepare: &PrepareGrader = &|options| Ok(Box::new(Grader::prepare(options)?));
    grade_class_with(arguments, options, prepare)
}

/// A function that returns the grader with these options.
pub type PrepareGrader<'p> =
    dyn for<'a> Fn(&'a GradeOptions) -> Result<Box<dyn SubmissionGrader + 'a>, Error> + 'p;

/// Like [`grade_class`], with the grader that `prepare` returns. It is called when the input and the
/// lists have been read.
pub fn grade_class_with(
    arguments: &ClassArguments,
    options: &GradeOptions,
    prepare: &PrepareGrader,
) -> Result<Completion, Error> {
    let used = choose_lists(arguments, options)?;
    let given = &used.files.lists;
    check_lists(given)?;
    let options = &GradeOptions {
        policy: used.files.policy.clone(),
        ..options.clone()
    };
    let workspace = Workspace::find().map_err(GraderError::from)?;
    let path = arguments.input.as_deref().unwrap_or(Path::new("."));
    if let Some(folder) = &arguments.similarity_input {
        let out = arguments.out.as_deref();
        let others: Vec<&Path> = [path].into_iter().chain(out).collect();
        similarity::check_folder(folder, &others)?;
    }
    let input = Input::open(
        path,
        &workspace.cache_folder().join("classes"),
        options.handed_out,
        &roster::read_lists(given)?,
    )?;
    let mut recognised = input.class.clone();
    let lists = resolve_lists(&input, given);
    let entries = recognised.entries.iter_mut();
    let mut infos: Vec<&mut EntryInfo> = entries.map(|entry| &mut entry.info).collect();
    let all = infos.len();
    let findings = lists::complete_entries(&lists, &mut infos)?;
    recognised.notes.extend_from_slice(&findings.warnings);
    let listed = findings.check(&lists, all);
    let missing = findings.missing;
    let manual = read_manual_points(given, options.handed_out)?;
    let entries = recognised.entries.iter();
    let people: Vec<&Person> = entries.flat_map(|entry| &entry.info.people).collect();
    manual.check_students(&people)?;
    if let Some(folder) = &arguments.similarity_input {
        let entries = &recognised.entries;
        print(similarity::write_input(
            folder,
            entries,
            options.handed_out,
        )?);
    }
    let (Some(out), false) = (&arguments.out, arguments.dry_run) else {
        print(render_preview(&recognised, &missing, options.handed_out));
        if let Err(error) = listed {
            print(format!("  this class would not be graded: {error}\n\n"));
        }
        return Ok(Completion::Complete);
    };

    listed?;
    let grader = prepare(options)?;
    let known: Vec<&Person> = people.into_iter().chain(&missing).collect();
    warn_about_extensions(grader.policy(), &known);
    let store = Store::new(out);
    check_out(&store, path, arguments.shard)?;
    let settings = grader.settings()?;
    let run = Run {
        shard: arguments.shard,
        lists: used.kept.clone(),
        tasks: grader.task_points(),
        ..start_or_resume(&store, settings, arguments.regrade)?
    };
    store.remove_temporary_files()?;
    let warnings = render_warnings(&recognised);
    let all: Vec<&str> = recognised
        .entries
        .iter()
        .map(|entry| entry.id.as_str())
        .collect();
    let removed = find_removed(&store, &all)?;
    let class = file_hash(all.join("\n").as_bytes());
    let entries = arguments
        .shard
        .unwrap_or(Shard::ALL)
        .select(recognised.entries);
    let run = Run {
        entries: entries.iter().map(|entry| entry.id.clone()).collect(),
        class,
        ..run
    };
    used.save(&store)?;
    store.write_run(&run)?;
    used.remove_others(&store)?;
    let run = save_previous_scores(&store, run)?;
    let slots = slot_count(arguments.jobs);
    if arguments.estimate {
        let estimate = estimate(grader.as_ref(), &store, &run, entries, slots)?;
        print(estimate.render());
        return Ok(Completion::Complete);
    }
    let results = grade_entries(grader.as_ref(), &store, &run, &entries, slots)?;
    let run = Run {
        state: RoundState::Finished,
        ..run
    };
    store.write_run(&run)?;

    let changes = Changes {
        regrade: find_regrade_changes(&store, &run, &results)?,
        resubmitted: find_resubmitted(&store, &results)?,
        removed,
        grades: None,
    };
    print(warnings);
    let class = ClassContext {
        store: &store,
        run: &run,
        lists: given,
        policy: grader.policy(),
        manual: &manual,
        missing,
    };
    class.finish(results, changes)
}

/// Returns the lists on the command line and those that the output folder has from the last run.
fn choose_lists(arguments: &ClassArguments, options: &GradeOptions) -> Result<UsedLists, Error> {
    let store = arguments.out.as_deref().map(Store::new);
    let run = store.as_ref().map(Store::read_run).transpose()?.flatten();
    let kept = arguments.out.as_deref().zip(run.as_ref());
    let kept = kept.map(|(folder, run)| KeptIn {
        folder,
        lists: &run.lists,
    });
    let given = ListFiles {
        policy: options.policy.clone(),
        lists: arguments.lists.clone(),
    };
    let used = UsedLists::choose(given, kept, &[])?;
    used.print_notes();
    Ok(used)
}

/// Reads the manual points, if a file is given.
pub fn read_manual_points(
    lists: &Lists,
    handed_out: &HandedOut,
) -> Result<ManualPointsList, Error> {
    match &lists.manual_points {
        Some(path) => ManualPointsList::read(path, handed_out),
        None => Ok(ManualPointsList::default()),
    }
}

/// Returns the lists given on the command line. If no roster is given, the one that classroom50
/// writes beside its clones is used.
fn resolve_lists(input: &Input, lists: &Lists) -> Lists {
    let own = match input.class.layout {
        Layout::GitHub => input.root.find(CLASSROOM50_SCORES),
        Layout::Gradescope | Layout::Canvas | Layout::Moodle | Layout::Plain => None,
    };
    let roster = lists.roster.clone().or(own.map(|node| node.path.clone()));
    Lists {
        roster,
        ..lists.clone()
    }
}

/// Returns the run to resume or to start. Scores that depend on other settings are never mixed with
/// the existing ones, and existing scores are replaced only with `--regrade`.
fn start_or_resume(store: &Store, settings: Settings, regrade: bool) -> Result<Run, Error> {
    let run = match (store.read_run()?, regrade) {
        (None, true) => {
            let out = store.folder().display();
            return Err(Error::User(format!(
                "{out} holds no scores yet: leave out --regrade"
            )));
        }
        (None, false) => Run::first_round(settings),
        // A stopped regrade is resumed, with or without `--regrade`. But a round that was finished once
        // is regraded, even if a later run of it, or an estimate, has not come to its end.
        (Some(run), _) if run.settings == settings && (!regrade || !run.was_finished()) => {
            run.resume()
        }
        (Some(run), true) => run.next_round(settings),
        (Some(run), false) => {
            return Err(Error::User(format!(
                "{} has scores that cannot be compared with new ones: {} changed; use --regrade to \
                 grade everything again and list the changes, or name a new folder",
                store.folder().display(),
                run.settings.differences(&settings).join(", ")
            )));
        }
    };
    Ok(run)
}

/// Saves the scores from before a regrade, unless that has been done. The round has already started in
/// `run.json`, so that a run killed here cannot be resumed as the last round, whose comparison with the
/// one before it would be lost.
fn save_previous_scores(store: &Store, run: Run) -> Result<Run, Error> {
    if run.state != RoundState::SavesPrevious {
        return Ok(run);
    }
    store.save_previous_scores()?;
    let run = Run {
        state: RoundState::Started,
        ..run
    };
    store.write_run(&run)?;
    Ok(run)
}

/// Rejects an output folder in the input, and one with the results of another part.
fn check_out(store: &Store, input: &Path, shard: Option<Shard>) -> Result<(), Error> {
    let out = store.folder();
    if input.is_dir() && contains(input, out) {
        return Err(Error::User(format!(
            "{} is in {}: the results would be taken for submissions; choose another folder for --out",
            out.display(),
            input.display()
        )));
    }
    let title = |shard: Option<Shard>| match shard {
        Some(shard) => format!("part {shard}"),
        None => "the whole class".to_owned(),
    };
    match store.read_run()? {
        Some(run) if run.shard != shard => Err(Error::User(format!(
            "{} has the results of {}, and not of {}: name another folder, or remove this one",
            out.display(),
            title(run.shard),
            title(shard)
        ))),
        Some(_) | None => Ok(()),
    }
}

/// Grades the first entries without a result, two per slot, and measures each.
fn estimate(
    grader: &dyn SubmissionGrader,
    store: &Store,
    run: &Run,
    entries: Vec<Entry>,
    slots: usize,
) -> Result<Estimate, Error> {
    let is_open = |entry: &Entry| !is_done(grader, store, run, entry);
    let mut sample: Vec<Entry> = entries.into_iter().filter(is_open).collect();
    let rest = sample.split_off(sample.len().min(2 * slots));
    let progress = Progress::new(sample.len(), slots);
    let entry_grader = EntryGrader {
        grader,
        store,
        run,
        progress: &progress,
    };
    let times = queue::run(&sample, slots, |slot, entry| {
        let started_at = Instant::now();
        entry_grader
            .grade(slot, entry)
            .map(|_| started_at.elapsed())
    });
    progress.finish();
    let times: Result<Vec<Duration>, _> = times.into_iter().collect();
    Ok(Estimate {
        times: times?,
        remaining: rest.len(),
        slots,
    })
}

fn grade_entries(
    grader: &dyn SubmissionGrader,
    store: &Store,
    run: &Run,
    entries: &[Entry],
    slots: usize,
) -> Result<Vec<EntryResult>, Error> {
    let progress = Progress::new(entries.len(), slots);
    let entry_grader = EntryGrader {
        grader,
        store,
        run,
        progress: &progress,
    };
    let results = queue::run(entries, slots, |slot, entry| {
        entry_grader.grade(slot, entry)
    });
    progress.finish();
    results.into_iter().collect()
}

fn slot_count(jobs: Option<u16>) -> usize {
    let cores = || thread::available_parallelism().map_or(1, NonZero::get);
    jobs.map_or_else(cores, usize::from)
}

/// Returns the changes that a regrade made, or `None` in a folder's first round.
fn find_regrade_changes(
    store: &Store,
    run: &Run,
    results: &[EntryResult],
) -> Result<Option<RegradeChanges>, Error> {
    let Some(before) = &run.before else {
        return Ok(None);
    };
    let mut drifts = Vec::new();
    for result in results {
        let was = store.previous_score(&result.id)?;
        drifts.extend(was.and_then(|was| compare_scores(&result.id, &was, result.score())));
    }
    Ok(Some(RegradeChanges {
        drifts,
        causes: before.differences(&run.settings),
    }))
}

#[cfg(test)]
mod tests;
