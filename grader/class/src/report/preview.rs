//! `--dry-run`: who would be graded from what.

use std::fmt::{self, Write};

use grader::tame::tame;

use crate::entry::{Entry, Person};
use crate::input::collect;
use crate::layout::{Found, Unmatched};

/// The most characters of a line's parts.
const LONGEST: usize = 200;

/// What was found, and what each would be graded from.
pub fn preview(found: &Found, missing: &[Person]) -> String {
    let mut text = String::new();
    write_preview(&mut text, found, missing).expect("text takes text");
    text
}

fn write_preview(out: &mut String, found: &Found, missing: &[Person]) -> fmt::Result {
    writeln!(
        out,
        "\n  {} in {}\n",
        count(found.entries.len()),
        found.layout.words()
    )?;
    let mut gradable = 0;
    for entry in &found.entries {
        let what = what(entry);
        gradable += usize::from(what.is_ok());
        let who = shown(&entry.about.words());
        let late = if entry.about.late { ", late" } else { "" };
        match what {
            Ok(files) => writeln!(out, "  {who}{late}: {files}")?,
            Err(why) => writeln!(out, "  {who}{late}: nothing to grade: {}", shown(&why))?,
        }
        writeln!(out, "      {}", shown(&entry.about.from))?;
    }
    write_doubts(out, found)?;
    if !missing.is_empty() {
        writeln!(out, "\n  in the lists, and nothing handed in:")?;
        for person in missing {
            writeln!(out, "      {}", shown(person.words()))?;
        }
    }
    writeln!(
        out,
        "\n  {gradable} of {} can be graded\n",
        found.entries.len()
    )
}

/// What a person has to see to: to be said as well where there are grades, which have no line for it.
pub fn doubts(found: &Found) -> String {
    let mut text = String::new();
    write_doubts(&mut text, found).expect("text takes text");
    text
}

fn write_doubts(out: &mut String, found: &Found) -> fmt::Result {
    for (one, other) in twice(&found.entries) {
        writeln!(
            out,
            "\n  {one} and {other} are of the same person: keep the one that counts"
        )?;
    }
    if !found.unmatched.is_empty() {
        writeln!(out, "\n  belongs to nobody:")?;
    }
    for Unmatched { name, why } in &found.unmatched {
        writeln!(out, "      {}: {}", shown(name), shown(why))?;
    }
    Ok(())
}

fn count(entries: usize) -> String {
    match entries {
        1 => "1 submission".to_owned(),
        several => format!("{several} submissions"),
    }
}

fn what(entry: &Entry) -> Result<String, String> {
    let submission = collect(entry)?;
    let lacks = submission.files.iter().filter(|(_, text)| text.is_err());
    let lacks: Vec<String> = lacks
        .filter_map(|(_, text)| text.as_ref().err().map(ToString::to_string))
        .collect();
    Ok(match lacks.as_slice() {
        [] => "five files".to_owned(),
        lacks => format!(
            "{} of 5 files; {}",
            submission.files.len() - lacks.len(),
            lacks.join("; ")
        ),
    })
}

/// Pairs of entries that name the same person.
fn twice(entries: &[Entry]) -> Vec<(&str, &str)> {
    let mut pairs = Vec::new();
    for (place, one) in entries.iter().enumerate() {
        for other in &entries[place + 1..] {
            let same = |one: &Person, other: &Person| one.is(other) || one == other;
            let mut people = one.about.people.iter();
            if people.any(|one| other.about.people.iter().any(|other| same(one, other))) {
                pairs.push((one.id.as_str(), other.id.as_str()));
            }
        }
    }
    pairs
}

fn shown(text: &str) -> String {
    tame(text, LONGEST).replace('\n', "\\n")
}
