//! Input for similarity checkers such as JPlag, Dolos and MOSS. Each task file has a folder, which
//! contains a numbered file for each submission. The numbered file contains only the lines that the
//! students wrote themselves. This module doesn't detect similar code itself: it only finds
//! submissions that are identical.
//!
//! The folder can be uploaded to a service, since it doesn't contain names. The key to the numbers
//! and the list of identical submissions are written next to it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use grader::files;
use grader::handed_out::{HandedOut, own_lines};
use judging::content_hash::ContentHash;

use crate::entry::Entry;
use crate::error::Error;
use crate::input::collect_submission;
use crate::names::joined;
use crate::paths::{beside, contains};
use crate::report::text::one_line;
use crate::table::{Table, safe_cell};

/// A submission and the lines its students wrote in each file.
struct OwnWork<'a> {
    number: usize,
    entry: &'a Entry,
    /// The lines, keyed by file name. Files without such lines are left out.
    files: BTreeMap<&'static str, String>,
}

impl OwnWork<'_> {
    /// Returns the id and the names of the people, as cells of a table.
    fn cells(&self) -> [String; 2] {
        [&self.entry.id, &self.entry.info.display_names()].map(|text| safe_cell(text))
    }

    fn content_hash(&self) -> String {
        let mut hash = ContentHash::default();
        for (file, text) in &self.files {
            hash.add(file.as_bytes());
            hash.add(text.as_bytes());
        }
        hash.hex()
    }
}

/// Checks that the folder for anonymous files, if there is one, is empty and doesn't overlap with the
/// input or the output. `option` is the command-line option that names the folder.
pub fn check_folder(folder: Option<&PathBuf>, others: &[&Path], option: &str) -> Result<(), Error> {
    let Some(folder) = folder else {
        return Ok(());
    };
    if fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(Error::user(format!(
            "{} is not empty: choose a new folder for {option}",
            folder.display()
        )));
    }
    for other in others {
        if contains(folder, other) || contains(other, folder) {
            return Err(Error::user(format!(
                "{} and {} must not contain each other, or names would leak: choose a different \
                 folder for {option}",
                folder.display(),
                other.display()
            )));
        }
    }
    Ok(())
}

/// Writes the folder, the key and the list of identical submissions. Returns the text for the
/// terminal.
pub fn write_input(
    folder: &Path,
    entries: &[Entry],
    handed_out: &'static HandedOut,
) -> Result<String, Error> {
    let mut all = Vec::new();
    for entry in entries {
        let Ok(submission) = collect_submission(entry, handed_out) else {
            continue;
        };
        let own = submission.files.iter().filter_map(|(file, text)| {
            let own = own_lines(file, text.as_ref().ok()?);
            (!own.is_empty()).then_some((file.name, own))
        });
        let files: BTreeMap<&'static str, String> = own.collect();
        if !files.is_empty() {
            all.push(OwnWork {
                number: 0,
                entry,
                files,
            });
        }
    }
    // Numbers in entry order would reveal names to anyone with a class list.
    let mut order: Vec<&mut OwnWork> = all.iter_mut().collect();
    order.sort_by_cached_key(|work| work.content_hash());
    for (number, work) in (1..).zip(order) {
        work.number = number;
    }
    for work in &all {
        for (file, text) in &work.files {
            let folder = folder.join(file.trim_end_matches(".rs"));
            let path = folder.join(format!("{:04}.rs", work.number));
            files::write_with_parents(path, text)?;
        }
    }
    let key = beside(folder, "key.csv");
    files::write(&key, key_table(&all).to_csv())?;
    let identical = identical(&all);
    let list = beside(folder, "identical.csv");
    files::write(&list, identical_table(&identical).to_csv())?;
    Ok(render(folder, &key, &list, all.len(), &identical))
}

fn key_table(all: &[OwnWork]) -> Table {
    let row = |work: &OwnWork| {
        let [id, names] = work.cells();
        vec![format!("{:04}", work.number), id, names]
    };
    let header = ["number", "submission", "names"];
    Table::new(&header, all.iter().map(row).collect())
}

/// Returns the groups of submissions whose students wrote the same lines.
fn identical<'a, 'e>(all: &'a [OwnWork<'e>]) -> Vec<Vec<&'a OwnWork<'e>>> {
    let mut same: BTreeMap<Vec<(&str, String)>, Vec<&OwnWork>> = BTreeMap::new();
    for work in all {
        let texts = work.files.iter();
        let texts = texts.map(|(file, text)| (*file, joined(text.split_whitespace(), " ")));
        same.entry(texts.collect()).or_default().push(work);
    }
    let groups = same.into_values().filter(|works| works.len() > 1);
    let mut groups: Vec<Vec<&OwnWork>> = groups.collect();
    groups.sort_by_key(|works| works[0].entry.id.as_str());
    groups
}

fn identical_table(groups: &[Vec<&OwnWork>]) -> Table {
    let mut rows = Vec::new();
    for (number, works) in (1..).zip(groups) {
        let is_expected = is_one_group(works);
        let expected = if is_expected { "same group" } else { "" };
        for work in works {
            let [id, names] = work.cells();
            rows.push(vec![
                i32::to_string(&number),
                id,
                names,
                expected.to_owned(),
            ]);
        }
    }
    Table::new(&["set", "submission", "names", "expected"], rows)
}

/// Returns whether the roster lists all of these people in the same group. They may then hand in
/// the same code.
fn is_one_group(works: &[&OwnWork]) -> bool {
    let people = works.iter().flat_map(|work| &work.entry.info.people);
    let groups: BTreeSet<&str> = people.map(|person| person.group.as_str()).collect();
    groups.len() == 1 && !groups.contains("")
}

fn render(
    folder: &Path,
    key: &Path,
    list: &Path,
    count: usize,
    identical: &[Vec<&OwnWork>],
) -> String {
    let mut text =
        format!("\n  students' own lines from {count} submissions, for a similarity checker\n");
    for works in identical {
        let ids = joined(works.iter().map(|work| &work.entry.id), ", ");
        let is_expected = is_one_group(works);
        let expected = if is_expected { " (same group)" } else { "" };
        text += &format!("  identical{expected}: {}\n", one_line(&ids));
    }
    for path in [folder, key, list] {
        text += &format!("  {}\n", path.display());
    }
    text
}
