//! `cargo class merge`: merges the parts of a class that several machines have graded.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use grader::options::GradeOptions;
use grader::policy::Policy;
use grader::printing::print;
use judging::sanitize::sanitize_line;

use crate::cli::MergeArguments;
use crate::drift::{Changes, RemovedEntry, find_removed, find_resubmitted};
use crate::entry::{EntryInfo, Person};
use crate::error::Error;
use crate::grade::{Completion, read_manual_points};
use crate::late::warn_about_extensions;
use crate::list_memory::{KeptIn, ListFiles, UsedLists};
use crate::lists;
use crate::model::{GradedClass, count_points};
use crate::outcome::EntryResult;
use crate::output::write_results;
use crate::run::Run;
use crate::shard::Shard;
use crate::store::Store;

/// Copies the shards' results into one folder, and writes the class's files.
pub fn merge_shards(arguments: &MergeArguments) -> Result<Completion, Error> {
    check_out(arguments)?;
    let shards: Result<Vec<(&PathBuf, Run)>, Error> = arguments
        .shards
        .iter()
        .map(|path| Ok((path, read_finished_run(path)?)))
        .collect();
    let shards = shards?;
    let (first, run) = &shards[0];
    for (other, theirs) in &shards[1..] {
        check_compatible((first, run), (other, theirs))?;
    }
    let parts: Vec<Shard> = shards.iter().filter_map(|(_, run)| run.shard).collect();
    let missing = Shard::missing(&parts);
    if !missing.is_empty() {
        return Err(Error::MissingShards(missing));
    }
    let out = Store::new(&arguments.out);
    let used = choose_lists(arguments, &out, &shards)?;
    let lists = &used.files.lists;
    let policy = match &used.files.policy {
        Some(path) => Policy::read(path)?,
        None => Policy::default(),
    };
    let mut sources: BTreeMap<String, &Path> = BTreeMap::new();
    for (path, run) in &shards {
        let shard = Store::new(path);
        // Older runs did not list their entries. In others, no entry means that the class has fewer
        // entries than shards, and the folder may have those of students who are gone.
        let current = |id: &String| run.class.is_empty() || run.entries.contains(id);
        for id in shard.ids()?.into_iter().filter(current) {
            if let Some(other) = sources.insert(id.clone(), path) {
                return Err(Error::DuplicateEntry {
                    id,
                    one: other.to_owned(),
                    other: (*path).clone(),
                });
            }
        }
    }
    out.remove_temporary_files()?;
    for (id, path) in &sources {
        out.copy_entry(id, &Store::new(path))?;
    }
    let run = &Run {
        shard: None,
        entries: sources.keys().cloned().collect(),
        lists: used.kept.clone(),
        ..run.clone()
    };
    used.save(&out)?;
    out.write_run(run)?;
    used.remove_others(&out)?;

    let rows: Vec<EntryResult> = out.results()?;
    let rows = rows.into_iter().filter(|row| sources.contains_key(&row.id));
    let mut rows: Vec<EntryResult> = rows.collect();
    let mut infos: Vec<&mut EntryInfo> = rows.iter_mut().map(|row| &mut row.info).collect();
    if lists.roster.is_some() {
        infos
            .iter_mut()
            .for_each(|info| info.forget_groups_and_extensions());
    }
    let all = infos.len();
    let findings = lists::complete_entries(lists, &mut infos)?;
    findings.check(lists, all)?;
    for warning in &findings.warnings {
        print(format!("  {}\n", sanitize_line(warning, 400)));
    }
    let missing = findings.missing;
    let manual = read_manual_points(lists, &GradeOptions::default())?;
    let people: Vec<&Person> = rows.iter().flat_map(|row| &row.info.people).collect();
    manual.check_students(&people)?;
    let all: Vec<&Person> = people.into_iter().chain(&missing).collect();
    warn_about_extensions(&policy, &all);
    let ids: Vec<&str> = sources.keys().map(String::as_str).collect();
    let mut removed = find_removed(&out, &ids)?;
    for (path, _) in &shards {
        let of_shard = find_removed(&Store::new(path), &ids)?;
        let is_new = |entry: &RemovedEntry| removed.iter().all(|other| other.id != entry.id);
        let of_shard: Vec<RemovedEntry> = of_shard.into_iter().filter(is_new).collect();
        removed.extend(of_shard);
    }
    let changes = Changes {
        regrade: None,
        resubmitted: find_resubmitted(&out, &rows)?,
        removed,
        grades: None,
    };
    let class = GradedClass {
        exam: run.settings.exam.clone(),
        exam_hash: run.settings.exam_hash.clone(),
        isolation: run.settings.isolation.clone(),
        rows: count_points(rows, &policy, &manual, &run.tasks)?,
        missing,
    };
    write_results(&class, &out, lists, run, changes)?;
    Ok(match class.fault_count() {
        0 => Completion::Complete,
        _ => Completion::Incomplete,
    })
}

/// Rejects an output folder in the results of a shard: each entry would be replaced while it is
/// copied.
fn check_out(arguments: &MergeArguments) -> Result<(), Error> {
    // The output folder may not exist yet.
    let mut existing = arguments.out.ancestors();
    let Some(out) = existing.find_map(|folder| folder.canonicalize().ok()) else {
        return Ok(());
    };
    let holds_out = |shard: &&PathBuf| shard.canonicalize().is_ok_and(|s| out.starts_with(s));
    match arguments.shards.iter().find(holds_out) {
        Some(shard) => Err(Error::MergeIntoShard {
            out: arguments.out.clone(),
            shard: shard.clone(),
        }),
        None => Ok(()),
    }
}

/// Returns the lists on the command line, those that were given to the last merge, and those that all
/// shards were graded with.
fn choose_lists(
    arguments: &MergeArguments,
    out: &Store,
    shards: &[(&PathBuf, Run)],
) -> Result<UsedLists, Error> {
    let given = ListFiles {
        policy: arguments.policy.clone(),
        lists: arguments.lists.clone(),
    };
    let last = out.read_run()?;
    let last = last.as_ref().map(|run| KeptIn {
        folder: out.folder(),
        lists: &run.lists,
    });
    let parts = shards.iter().map(|(folder, run)| KeptIn {
        folder,
        lists: &run.lists,
    });
    let used = UsedLists::choose(given, last, &parts.collect::<Vec<_>>())?;
    used.print_notes();
    Ok(used)
}

fn read_finished_run(path: &Path) -> Result<Run, Error> {
    let run = Store::new(path).read_run()?;
    let run = run.ok_or_else(|| Error::NotAShard(path.to_owned()))?;
    if run.finished {
        Ok(run)
    } else {
        Err(Error::UnfinishedShard(path.to_owned()))
    }
}

/// Checks that two shards are parts of the same class, and that their scores can be compared: the
/// exam, the isolation and the options must be the same. The grader's executable and the compiler may
/// differ between machines.
fn check_compatible(one: (&PathBuf, &Run), other: (&PathBuf, &Run)) -> Result<(), Error> {
    let local = [
        "the grader",
        "the compiler, the dependencies or the reference",
    ];
    let mut what = one.1.settings.differences(&other.1.settings);
    what.retain(|what| !local.contains(what));
    if one.1.class != other.1.class {
        Err(Error::DifferentClasses {
            one: one.0.clone(),
            other: other.0.clone(),
        })
    } else if what.is_empty() {
        Ok(())
    } else {
        Err(Error::IncompatibleShards {
            one: one.0.clone(),
            other: other.0.clone(),
            differences: what,
        })
    }
}

#[cfg(test)]
mod tests;
