//! Prints the output of `--dry-run`: the files that would be graded for each student.

use std::fmt::{self, Write};

use grader::handed_out::HandedOut;
use judging::sanitize::sanitize_line;

use crate::entry::{Entry, Person};
use crate::input::{NotCollected, collect_submission};
use crate::layout::{RecognisedClass, UnmatchedPath};

/// The maximum length of a name or reason, in characters.
const MAX_CHARS: usize = 1_000;

/// Renders the entries with the files that each would be graded from.
pub fn render_preview(
    class: &RecognisedClass,
    missing: &[Person],
    handed_out: &'static HandedOut,
) -> String {
    let mut text = String::new();
    write_preview(&mut text, class, missing, handed_out).expect("writing to a string succeeds");
    text
}

fn write_preview(
    out: &mut String,
    class: &RecognisedClass,
    missing: &[Person],
    handed_out: &'static HandedOut,
) -> fmt::Result {
    writeln!(
        out,
        "\n  {} in {}\n",
        count_submissions(class.entries.len()),
        class.layout.description()
    )?;
    let mut gradable = 0;
    for entry in &class.entries {
        let files = describe_files(entry, handed_out);
        gradable += usize::from(files.is_ok());
        let who = sanitized(&entry.info.display_names());
        let late = if entry.info.is_late() { ", late" } else { "" };
        match files {
            Ok(files) => writeln!(out, "  {who}{late}: {}", sanitized(&files))?,
            Err(why) => writeln!(out, "  {who}{late}: nothing to grade: {}", sanitized(&why))?,
        }
        writeln!(out, "      {}", sanitized(&entry.info.from))?;
    }
    write_warnings(out, class)?;
    if !missing.is_empty() {
        writeln!(out, "\n  on a roster, but nothing submitted:")?;
        for person in missing {
            writeln!(out, "      {}", sanitized(person.display_name()))?;
        }
    }
    writeln!(
        out,
        "\n  {gradable} of {} can be graded\n",
        class.entries.len()
    )
}

/// Renders the problems that the teacher has to resolve. They are part of the preview, and are also
/// printed after grading, since the grades do not include them.
pub fn render_warnings(class: &RecognisedClass) -> String {
    let mut text = String::new();
    write_warnings(&mut text, class).expect("writing to a string succeeds");
    text
}

fn write_warnings(out: &mut String, class: &RecognisedClass) -> fmt::Result {
    for note in &class.notes {
        writeln!(out, "\n  {}", sanitize_line(note, MAX_CHARS))?;
    }
    for (one, other) in duplicate_people(&class.entries) {
        let (one, other) = (sanitized(one), sanitized(other));
        writeln!(
            out,
            "\n  {one} and {other} belong to the same person: keep the one that counts, or set [attempts] \
             in the policy"
        )?;
    }
    if !class.unmatched.is_empty() {
        writeln!(out, "\n  not part of any submission:")?;
    }
    for UnmatchedPath { name, why } in &class.unmatched {
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

fn describe_files(entry: &Entry, handed_out: &'static HandedOut) -> Result<String, String> {
    let submission = collect_submission(entry, handed_out).map_err(NotCollected::into_text)?;
    let missing = submission.files.iter().filter(|(_, text)| text.is_err());
    let missing: Vec<String> = missing
        .filter_map(|(_, text)| text.as_ref().err().map(ToString::to_string))
        .collect();
    let count = submission.files.len();
    let mut text = match missing.as_slice() {
        [] if submission.is_as_handed_out() => {
            format!("all {count} files, as they were handed out")
        }
        [] => format!("all {count} files"),
        missing => format!(
            "{} of {count} files; {}",
            count - missing.len(),
            missing.join("; ")
        ),
    };
    for note in &submission.ignored_copies {
        text += "; ";
        text += note;
    }
    Ok(text)
}

/// Returns the pairs of entries that belong to the same person.
fn duplicate_people(entries: &[Entry]) -> Vec<(&str, &str)> {
    let mut pairs = Vec::new();
    for (index, one) in entries.iter().enumerate() {
        for other in &entries[index + 1..] {
            let mut people = one.info.people.iter();
            if people.any(|one| other.info.people.iter().any(|other| one.is_same(other))) {
                pairs.push((one.id.as_str(), other.id.as_str()));
            }
        }
    }
    pairs
}

fn sanitized(text: &str) -> String {
    sanitize_line(text, MAX_CHARS)
}
