//! Grades a class: reads a learning platform's export and writes the score files.

use std::num::NonZero;
use std::path::Path;
use std::thread;

use grader::grade::Grader;
use grader::options::GradeOptions;
use grader::printing::print;
use grader::workspace::Workspace;
use judging::content_hash::file_hash;

use crate::anonymous::Pseudonyms;
use crate::cli::{ClassArguments, Lists};
use crate::corrected;
use crate::entry::{Entry, EntryInfo, Person};
use crate::entry_completion::{check_listed, complete_entries};
use crate::entry_grader::EntryGrader;
use crate::error::Error;
use crate::final_grades::{self, GradeHistory};
use crate::input::Input;
use crate::late::warn_about_extensions;
use crate::list_memory::UsedLists;
use crate::outcome::EntryResult;
use crate::output::{ClassContext, check_lists};
use crate::paths::contains;
use crate::regrade_diff::find_removed;
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

/// A function that takes grading options and returns a grader.
pub type PrepareGrader<'p> =
    dyn for<'a> Fn(&'a GradeOptions) -> Result<Box<dyn SubmissionGrader + 'a>, Error> + 'p;

/// Like [`grade_class`], but with the grader returned by `prepare`, which is called after the input
/// and the lists have been read.
pub fn grade_class_with(
    arguments: &ClassArguments,
    options: &GradeOptions,
    prepare: &PrepareGrader,
) -> Result<Completion, Error> {
    let lists = Lists {
        policy: options.policy.clone(),
        ..arguments.lists.clone()
    };
    let mut used = UsedLists::choose(lists, arguments.out.as_deref(), &[])?;
    let given = &used.lists;
    check_lists(given)?;
    let mut options = options.clone();
    options.policy.clone_from(&given.policy);
    let workspace = Workspace::find()?;
    let path = arguments.input.as_deref().unwrap_or(Path::new("."));
    let out = arguments.out.as_deref();
    let others: Vec<&Path> = [path].into_iter().chain(out).collect();
    let own_lines = arguments.similarity_input.as_ref();
    similarity::check_folder(own_lines, &others, "--similarity-input")?;
    similarity::check_folder(given.anonymous.as_ref(), &others, "--anonymous")?;
    let store = out.map(Store::new);
    let last = store.as_ref().map(Store::read_run).transpose()?;
    let last = last.flatten().map(|run| run.choice);
    let choice = arguments.choice.or(&last.unwrap_or_default());
    let (cache, handed_out) = (workspace.cache_folder().join("classes"), options.handed_out);
    let known = roster::read_lists(given)?;
    let input = Input::open(&choice, path, &cache, handed_out, &known)?;
    let mut recognised = input.class.clone();
    if let Some(store) = &store {
        let pseudonyms = Pseudonyms::read(store)?;
        for Entry { id, info, .. } in &mut recognised.entries {
            info.pseudonym = pseudonyms.of(id);
        }
    }
    let infos = recognised.entries.iter_mut();
    let infos = infos.map(|entry| (&*entry.id, &mut entry.info));
    let (ids, mut infos): (Vec<&str>, Vec<&mut EntryInfo>) = infos.unzip();
    used.add_downloaded(input.class.layout.find_list(&input.root), out)?;
    let given = &used.lists;
    let findings = complete_entries(given, handed_out, &ids, &mut infos)?;
    recognised.notes.extend_from_slice(&findings.warnings);
    match (&arguments.corrected, &store) {
        (Some(folder), _) => {
            let history = store.as_ref().map(|store| store.read(final_grades::FILE));
            let history: Option<GradeHistory> = history.transpose()?.flatten();
            let last = store.as_ref().map(Store::results).transpose()?;
            let mut last = last.unwrap_or_default();
            last.retain(|result| result.info.is_corrected);
            // Corrected files may earn fewer points than another attempt, which then counts. Used
            // again, a person's name must still stand for the same attempt.
            let counts = |id: &str, own: &Person| {
                let is_own =
                    |last: &&EntryResult| last.info.people.iter().any(|it| it.is_same(own));
                let mut corrected = last.iter().filter(is_own).peekable();
                match corrected.peek() {
                    Some(_) => corrected.any(|last| last.id == id),
                    None => history.iter().any(|all| all.counts(id, own)),
                }
            };
            corrected::replace_files(&mut recognised, folder, path, handed_out, counts)?;
        }
        (None, Some(store)) => corrected::check_none_lost(store)?,
        (None, None) => {}
    }
    if let Some(folder) = &arguments.similarity_input {
        let entries = &recognised.entries;
        print(similarity::write_input(folder, entries, handed_out)?);
    }
    let infos = recognised.entries.iter();
    let infos = Vec::from_iter(infos.map(|entry| (entry.id.as_str(), &entry.info)));
    let (Some(store), false) = (store, arguments.dry_run) else {
        let missing = &findings.missing;
        print(render_preview(&recognised, missing, handed_out));
        if let Err(error) = check_listed(&infos, given) {
            print(format!("  this class cannot be graded yet: {error}\n\n"));
        }
        return Ok(Completion::Complete);
    };

    check_listed(&infos, given)?;
    let grader = prepare(&options)?;
    warn_about_extensions(grader.policy(), &infos, &findings.missing);
    check_out(&store, path, arguments.shard)?;
    let settings = grader.settings()?;
    let run = start_or_resume(&store, settings, arguments.regrade)?;
    store.remove_temporary_files()?;
    let warnings = render_warnings(&recognised);
    let all = recognised.entries.iter();
    let all: Vec<&str> = all.map(|entry| entry.id.as_str()).collect();
    let removed = find_removed(&[&store], &all)?;
    let class = file_hash(all.join("\n").as_bytes());
    let shard = arguments.shard.unwrap_or(Shard::ALL);
    let entries = shard.select(recognised.entries);
    let run = Run {
        shard: arguments.shard,
        lists: used.kept.clone(),
        choice,
        items: grader.item_points(),
        entries: entries.iter().map(|entry| entry.id.clone()).collect(),
        class,
        ..run
    };
    used.save(&store, &run)?;
    let mut run = save_previous_scores(&store, run)?;
    let slots = slot_count(arguments.jobs);
    let entry_grader = EntryGrader {
        grader: grader.as_ref(),
        store: &store,
        run: &run,
    };
    if arguments.estimate {
        print(entry_grader.estimate(entries, slots)?.render());
        return Ok(Completion::Complete);
    }
    let results = entry_grader.grade_all(&entries, slots)?;
    let results: Vec<EntryResult> = results.into_iter().map(|(result, _)| result).collect();
    run.state = RoundState::Finished;
    store.write_run(&run)?;

    print(warnings);
    let class = ClassContext {
        store: &store,
        run: &run,
        lists: given,
        policy: grader.policy(),
        handed_out,
        findings,
    };
    let finished = class.finish(results, removed);
    used.forget_refused(finished, &store, &run)
}

/// Returns the run to resume or to start. Scores from different settings are never mixed, and
/// existing scores are only replaced with `--regrade`.
fn start_or_resume(store: &Store, settings: Settings, regrade: bool) -> Result<Run, Error> {
    match (store.read_run()?, regrade) {
        (None, true) => {
            let out = store.folder().display();
            Err(Error::user(format!(
                "{out} contains no scores that could be compared with new ones: leave out \
                 --regrade"
            )))
        }
        (None, false) => Ok(Run::first_round(settings)),
        // A stopped regrade is resumed, with or without `--regrade`. A round that has already been
        // finished, however, is regraded, even if a later run or estimate in that round was
        // stopped.
        (Some(run), _) if run.settings == settings && (!regrade || !run.was_finished()) => {
            Ok(run.resume())
        }
        (Some(run), true) => Ok(run.next_round(settings)),
        (Some(run), false) => Err(Error::user(format!(
            "the scores in {} can't be compared with new ones, because {} changed: use --regrade \
             to grade everything again and list the changes, or choose a new folder",
            store.folder().display(),
            run.settings.differences(&settings).join(", ")
        ))),
    }
}

/// Saves the scores from before a regrade, unless this has already been done. `run.json` already
/// contains the new round at this point. If it didn't, a run killed here could be resumed as the
/// previous round, and that round's comparison with the one before it would be lost.
fn save_previous_scores(store: &Store, mut run: Run) -> Result<Run, Error> {
    if run.state == RoundState::SavesPrevious {
        store.save_previous_scores()?;
        run.state = RoundState::Started;
        store.write_run(&run)?;
    }
    Ok(run)
}

/// Rejects an output folder that is in the input or contains the results of another shard.
fn check_out(store: &Store, input: &Path, shard: Option<Shard>) -> Result<(), Error> {
    let out = store.folder();
    if input.is_dir() && contains(input, out) {
        return Err(Error::user(format!(
            "{} is inside {}, so the results would be mistaken for submissions: choose a different folder for --out",
            out.display(),
            input.display()
        )));
    }
    let title = |shard: Option<Shard>| match shard {
        Some(shard) => format!("part {shard}"),
        None => "the whole class".to_owned(),
    };
    match store.read_run()? {
        Some(run) if run.shard != shard => Err(Error::user(format!(
            "{} contains the results of {}, not of {}: choose a different folder, or remove this \
             one",
            out.display(),
            title(run.shard),
            title(shard)
        ))),
        Some(_) | None => Ok(()),
    }
}

fn slot_count(jobs: Option<u16>) -> usize {
    let cores = || thread::available_parallelism().map_or(1, NonZero::get);
    jobs.map_or_else(cores, usize::from)
}

#[cfg(test)]
mod tests;
