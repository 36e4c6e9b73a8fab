//! `--dry-run`: who would be graded from what.

use std::fmt::{self, Write};

use grader::sanitize::sanitize;

use crate::entry::{Entry, Person};
use crate::input::collect_submission;
use crate::layout::{RecognisedClass, UnmatchedPath};

/// The most characters of a line's parts.
const MAX_CHARS: usize = 200;

/// What was found, and what each would be graded from.
pub fn render_preview(found: &RecognisedClass, missing: &[Person]) -> String {
    let mut text = String::new();
    write_preview(&mut text, found, missing).expect("text takes text");
    text
}

fn write_preview(out: &mut String, found: &RecognisedClass, missing: &[Person]) -> fmt::Result {
    writeln!(
        out,
        "\n  {} in {}\n",
        count_submissions(found.entries.len()),
        found.layout.description()
    )?;
    let mut gradable = 0;
    for entry in &found.entries {
        let what = describe_files(entry);
        gradable += usize::from(what.is_ok());
        let who = sanitized(&entry.info.display_names());
        let late = if entry.info.late { ", late" } else { "" };
        match what {
            Ok(files) => writeln!(out, "  {who}{late}: {files}")?,
            Err(why) => writeln!(out, "  {who}{late}: nothing to grade: {}", sanitized(&why))?,
        }
        writeln!(out, "      {}", sanitized(&entry.info.from))?;
    }
    write_warnings(out, found)?;
    if !missing.is_empty() {
        writeln!(out, "\n  in the lists, and nothing handed in:")?;
        for person in missing {
            writeln!(out, "      {}", sanitized(person.display_name()))?;
        }
    }
    writeln!(
        out,
        "\n  {gradable} of {} can be graded\n",
        found.entries.len()
    )
}

/// What a person has to see to: to be said as well where there are grades, which have no line for it.
pub fn render_warnings(found: &RecognisedClass) -> String {
    let mut text = String::new();
    write_warnings(&mut text, found).expect("text takes text");
    text
}

fn write_warnings(out: &mut String, found: &RecognisedClass) -> fmt::Result {
    for (one, other) in duplicate_people(&found.entries) {
        writeln!(
            out,
            "\n  {one} and {other} are of the same person: keep the one that counts"
        )?;
    }
    if !found.unmatched.is_empty() {
        writeln!(out, "\n  belongs to nobody:")?;
    }
    for UnmatchedPath { name, why } in &found.unmatched {
        writeln!(out, "      {}: {}", sanitized(name), sanitized(why))?;
    }
    Ok(())
}

fn count_submissions(entries: usize) -> String {
    match entries {
        1 => "1 submission".to_owned(),
        several => format!("{several} submissions"),
    }
}

fn describe_files(entry: &Entry) -> Result<String, String> {
    let submission = collect_submission(entry)?;
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
fn duplicate_people(entries: &[Entry]) -> Vec<(&str, &str)> {
    let mut pairs = Vec::new();
    for (place, one) in entries.iter().enumerate() {
        for other in &entries[place + 1..] {
            let same = |one: &Person, other: &Person| one.matches(other) || one == other;
            let mut people = one.info.people.iter();
            if people.any(|one| other.info.people.iter().any(|other| same(one, other))) {
                pairs.push((one.id.as_str(), other.id.as_str()));
            }
        }
    }
    pairs
}

fn sanitized(text: &str) -> String {
    sanitize(text, MAX_CHARS).replace('\n', "\\n")
}
