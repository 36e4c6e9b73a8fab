//! `cargo class merge`: merges the parts of a class that several machines have graded.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use grader::handed_out::HandedOut;
use grader::policy::Policy;
use grader::printing::print;
use judging::sanitize::sanitize_line;

use crate::anonymous::Pseudonyms;
use crate::cli::{Lists, MergeArguments};
use crate::entry::EntryInfo;
use crate::entry_completion::{check_listed, complete_entries};
use crate::error::Error;
use crate::late::warn_about_extensions;
use crate::list_memory::{FolderCopies, UsedLists};
use crate::names::joined;
use crate::output::{ClassContext, Completion};
use crate::paths::contains;
use crate::regrade_diff::find_removed;
use crate::run::{RoundState, Run};
use crate::shard::Shard;
use crate::similarity::check_folder;
use crate::store::Store;

/// Copies the shards' results into one folder and writes the class's files.
pub fn merge_shards(
    arguments: &MergeArguments,
    handed_out: &HandedOut,
) -> Result<Completion, Error> {
    check_out(arguments)?;
    let others = arguments.shards.iter().chain([&arguments.out]);
    let others: Vec<&Path> = others.map(PathBuf::as_path).collect();
    check_folder(arguments.lists.anonymous.as_ref(), &others, "--anonymous")?;
    let shards = arguments.shards.iter();
    let shards = shards.map(|path| read_finished_run(Store::new(path)));
    let shards: Vec<(Store, Run)> = shards.collect::<Result<_, Error>>()?;
    for other in &shards[1..] {
        check_compatible(&shards[0], other)?;
    }
    let parts: Vec<Shard> = shards.iter().filter_map(|(_, run)| run.shard).collect();
    let missing = Shard::missing(&parts);
    if !missing.is_empty() {
        let missing = joined(missing.iter().map(Shard::to_string), ", ");
        return Err(Error::user(format!(
            "results are missing for {missing}, so the merged grades would be incomplete: pass the \
             output folders of all parts"
        )));
    }
    let out = Store::new(&arguments.out);
    let given = Lists {
        policy: arguments.policy.clone(),
        ..arguments.lists.clone()
    };
    let parts = shards.iter();
    let parts = parts.map(|(shard, run)| (shard.folder(), &run.lists));
    let parts: Vec<FolderCopies> = parts.collect();
    let used = UsedLists::choose(given, Some(&arguments.out), &parts)?;
    let lists = &used.lists;
    let policy = match &lists.policy {
        Some(path) => {
            let items = shards[0].1.items.keys().map(String::as_str);
            Policy::for_exam(path, &Policy::read_text(path)?, items)?
        }
        None => Policy::default(),
    };
    let mut sources: BTreeMap<String, &Store> = BTreeMap::new();
    for (shard, run) in &shards {
        // The folder may also contain entries of students who have left.
        let current = |id: &String| run.entries.contains(id);
        for id in shard.ids()?.into_iter().filter(current) {
            if let Some(other) = sources.insert(id.clone(), shard) {
                return Err(Error::user(format!(
                    "{id} is in both {} and {}, probably because both were graded with the same \
                     --shard: grade one of them again with a different part, such as 2/8",
                    other.folder().display(),
                    shard.folder().display()
                )));
            }
        }
    }
    out.remove_temporary_files()?;
    for (id, shard) in &sources {
        out.copy_entry(id, shard)?;
    }
    let run = &Run {
        shard: None,
        entries: sources.keys().cloned().collect(),
        lists: used.kept.clone(),
        ..shards[0].1.clone()
    };
    used.save(&out, run)?;

    let mut rows = out.results()?;
    rows.retain(|row| sources.contains_key(&row.id));
    let pseudonyms = Pseudonyms::read(&out)?;
    for row in &mut rows {
        row.info.pseudonym = pseudonyms.of(&row.id);
    }
    let infos = rows.iter_mut().map(|row| (&*row.id, &mut row.info));
    let (ids, mut infos): (Vec<&str>, Vec<&mut EntryInfo>) = infos.unzip();
    if lists.roster.is_some() {
        for info in &mut infos {
            info.forget_groups_and_extensions();
        }
    }
    let findings = complete_entries(lists, handed_out, &ids, &mut infos)?;
    let infos = rows.iter().map(|row| (row.id.as_str(), &row.info));
    let infos = Vec::from_iter(infos);
    check_listed(&infos, lists)?;
    for warning in &findings.warnings {
        print(format!("  {}\n", sanitize_line(warning, 400)));
    }
    warn_about_extensions(&policy, &infos, &findings.missing);
    let ids: Vec<&str> = sources.keys().map(String::as_str).collect();
    let stores = shards.iter().map(|(shard, _)| shard);
    let stores: Vec<&Store> = [&out].into_iter().chain(stores).collect();
    let removed = find_removed(&stores, &ids)?;
    let class = ClassContext {
        store: &out,
        run,
        lists,
        policy: &policy,
        handed_out,
        findings,
    };
    let finished = class.finish(rows, removed);
    used.forget_refused(finished, &out, run)
}

/// Rejects an output folder inside a shard's results, because each entry would be replaced while it
/// is being copied.
fn check_out(arguments: &MergeArguments) -> Result<(), Error> {
    let holds_out = |shard: &&PathBuf| contains(shard, &arguments.out);
    match arguments.shards.iter().find(holds_out) {
        Some(shard) => Err(Error::user(format!(
            "{} is inside the shard's folder {}: choose a different folder for --out",
            arguments.out.display(),
            shard.display()
        ))),
        None => Ok(()),
    }
}

fn read_finished_run(shard: Store) -> Result<(Store, Run), Error> {
    let run = shard.read_run()?;
    let path = shard.folder().display();
    match run {
        Some(run) if run.state == RoundState::Finished => Ok((shard, run)),
        Some(_) => Err(Error::user(format!(
            "{path} is not finished: run the same `cargo class --shard` command again"
        ))),
        None => Err(Error::user(format!(
            "{path} contains no results from `cargo class --shard`: pass the output folders of \
             these commands"
        ))),
    }
}

/// Checks that two shards are parts of the same class, and that their scores can be compared: the
/// exam, the isolation and the options must be the same. The grader's executable and the compiler
/// may differ between machines.
fn check_compatible(one: &(Store, Run), other: &(Store, Run)) -> Result<(), Error> {
    let local = [
        "the grader",
        "the compiler, the dependencies or the reference",
    ];
    let mut what = one.1.settings.differences(&other.1.settings);
    what.retain(|what| !local.contains(what));
    let why = if one.1.class != other.1.class {
        " because submissions were added or removed between the two runs, so some could be \
         missing: run every `cargo class --shard` command again (existing results are kept)"
            .to_owned()
    } else if !what.is_empty() {
        format!(
            ": they differ in {}. Grade all parts with the same exam, isolation level and options",
            what.join(", ")
        )
    } else {
        return Ok(());
    };
    let [one, other] = [one, other].map(|(shard, _)| shard.folder().display());
    Err(Error::user(format!(
        "{one} and {other} cannot be merged{why}"
    )))
}

#[cfg(test)]
mod tests;
