//! `cargo class merge`: one class of the parts that several machines have graded.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use grader::policy::Policy;

use crate::class::Done;
use crate::cli::MergeArguments;
use crate::entry::About;
use crate::error::Error;
use crate::groups;
use crate::model::{Class, Line};
use crate::outcome::Row;
use crate::roster;
use crate::run::Run;
use crate::shard::Shard;
use crate::store::{Store, StoreError};
use crate::written::write;

/// Copies the shards' results together, and writes what the class is told by.
pub fn merge(arguments: &MergeArguments) -> Result<Done, Error> {
    let shards: Result<Vec<(&PathBuf, Run)>, Error> = arguments
        .shards
        .iter()
        .map(|path| Ok((path, finished(path)?)))
        .collect();
    let shards = shards?;
    let (first, run) = &shards[0];
    for (other, theirs) in &shards[1..] {
        belong_together((first, run), (other, theirs))?;
    }
    let parts: Vec<Shard> = shards.iter().filter_map(|(_, run)| run.shard).collect();
    let missing = Shard::missing(&parts);
    if !missing.is_empty() {
        return Err(Error::Incomplete(missing));
    }
    let policy = policy(arguments, &shards)?;

    let out = Store::at(&arguments.out);
    let mut taken: BTreeMap<String, &Path> = BTreeMap::new();
    for (path, _) in &shards {
        let shard = Store::at(path);
        for id in shard.ids()? {
            if let Some(other) = taken.insert(id.clone(), path) {
                return Err(Error::Twice {
                    id,
                    one: other.to_owned(),
                    other: (*path).clone(),
                });
            }
            copy(&shard.entry(&id), &out.entry(&id))?;
        }
    }
    let run = &Run {
        shard: None,
        ..run.clone()
    };
    out.set_run(run)?;

    let rows: Vec<Row> = out.rows()?;
    let rows = rows.into_iter().filter(|row| taken.contains_key(&row.id));
    let mut rows: Vec<Row> = rows.collect();
    let people = rows.iter_mut().flat_map(|row| &mut row.about.people);
    let mut missing = roster::join(&arguments.lists, &mut people.collect::<Vec<_>>())?;
    let mut abouts: Vec<&mut About> = rows.iter_mut().map(|row| &mut row.about).collect();
    groups::complete(&arguments.lists, &mut abouts, &mut missing)?;
    let class = Class {
        exam: run.settings.exam.clone(),
        exam_hash: run.settings.exam_hash.clone(),
        isolation: run.settings.isolation.clone(),
        lines: rows.into_iter().map(|row| Line::of(row, &policy)).collect(),
        missing,
    };
    write(&class, &out, &arguments.lists, None)?;
    Ok(match class.faults() {
        0 => Done::All,
        _ => Done::NotAll,
    })
}

/// The one that is named, else the one that all shards were graded with.
fn policy(arguments: &MergeArguments, shards: &[(&PathBuf, Run)]) -> Result<Policy, Error> {
    let (first, run) = &shards[0];
    if let Some(path) = &arguments.policy {
        return Ok(Policy::read(path)?);
    }
    if let Some((other, _)) = shards.iter().find(|(_, other)| other.policy != run.policy) {
        return Err(Error::Policies {
            one: (*first).clone(),
            other: (*other).clone(),
        });
    }
    Ok(match &run.policy {
        Some(text) => Policy::of_text(&first.join("run.json"), text)?,
        None => Policy::default(),
    })
}

fn finished(path: &Path) -> Result<Run, Error> {
    let run = Store::at(path).run()?;
    let run = run.ok_or_else(|| Error::NoShard(path.to_owned()))?;
    match run.finished {
        true => Ok(run),
        false => Err(Error::Unfinished(path.to_owned())),
    }
}

/// Scores are compared, so they must follow from the same exam, asked in the same way. Programs and
/// compilers are each machine's own.
fn belong_together(one: (&PathBuf, &Run), other: (&PathBuf, &Run)) -> Result<(), Error> {
    let local = [
        "the grader",
        "the compiler, the dependencies or the reference",
    ];
    let mut what = one.1.settings.differences(&other.1.settings);
    what.retain(|what| !local.contains(what));
    match what.is_empty() {
        true => Ok(()),
        false => Err(Error::Strangers {
            one: one.0.clone(),
            other: other.0.clone(),
            what,
        }),
    }
}

fn copy(from: &Path, to: &Path) -> Result<(), StoreError> {
    let at = |path: &Path| {
        let path = path.to_owned();
        move |source| StoreError::Io { path, source }
    };
    fs::create_dir_all(to).map_err(at(to))?;
    for entry in fs::read_dir(from).map_err(at(from))? {
        let entry = entry.map_err(at(from))?;
        let place = to.join(entry.file_name());
        fs::copy(entry.path(), &place).map_err(at(&place))?;
    }
    Ok(())
}
