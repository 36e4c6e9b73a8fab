//! Prints the output of `--dry-run`: the files that would be graded for each student.

use std::collections::BTreeSet;

use grader::handed_out::HandedOut;
use judging::sanitize::sanitize_line;

use crate::entry::{Entry, Person};
use crate::identity::attempts_by_person;
use crate::input::{NotCollected, collect_submission};
use crate::layout::{RecognisedClass, UnmatchedPath};
use grader::printing::counted;

/// The maximum length of a name or reason, in characters.
const MAX_CHARS: usize = 1_000;

/// Renders the entries, each with the files that would be graded.
pub fn render_preview(
    class: &RecognisedClass,
    missing: &[Person],
    handed_out: &'static HandedOut,
) -> String {
    let submissions = counted(class.entries.len(), "submission");
    let mut text = format!("\n  {submissions} in {}\n\n", class.layout.description());
    let mut gradable = 0;
    for entry in &class.entries {
        let files = describe_files(entry, handed_out);
        gradable += usize::from(files.is_ok());
        let files = files.unwrap_or_else(|why| format!("nothing to grade: {why}"));
        let who = sanitized(&entry.info.display_names());
        let late = if entry.info.is_late() { ", late" } else { "" };
        let (files, from) = (sanitized(&files), sanitized(&entry.info.from));
        text += &format!("  {who}{late}: {files}\n      {from}\n");
    }
    text += &render_warnings(class);
    if !missing.is_empty() {
        text += "\n  on a roster, but nothing submitted:\n";
    }
    for person in missing {
        text += &format!("      {}\n", sanitized(person.display_name()));
    }
    text + &format!(
        "\n  {gradable} of {} can be graded\n\n",
        class.entries.len()
    )
}

/// Renders the problems that the teacher has to resolve. They are part of the preview and are also
/// printed after grading, since the grades don't include them.
pub fn render_warnings(class: &RecognisedClass) -> String {
    let mut text = String::new();
    for note in &class.notes {
        text += &format!("\n  {}\n", sanitized(note));
    }
    for ids in several_of_one_person(&class.entries) {
        let ids: Vec<String> = ids.into_iter().map(sanitized).collect();
        text += &format!(
            "\n  {} belong to the same person: keep the one that counts, or set [attempts] in the policy\n",
            ids.join(" and ")
        );
    }
    if !class.unmatched.is_empty() {
        text += "\n  not part of any submission:\n";
    }
    for UnmatchedPath { name, why } in &class.unmatched {
        text += &format!("      {}: {}\n", sanitized(name), sanitized(why));
    }
    text
}

fn describe_files(entry: &Entry, handed_out: &'static HandedOut) -> Result<String, String> {
    let submission = collect_submission(entry, handed_out).map_err(NotCollected::into_text)?;
    let missing = submission.files.iter();
    let missing = missing.filter_map(|(file, text)| Some(text.as_ref().err()?.message(file.name)));
    let missing: Vec<String> = missing.collect();
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
        text += &format!("; {note}");
    }
    Ok(text)
}

/// For each person with several entries, returns their ids.
fn several_of_one_person(entries: &[Entry]) -> BTreeSet<Vec<&str>> {
    let people = entries.iter().map(|entry| entry.info.people.as_slice());
    let of_one = attempts_by_person(people).into_iter().map(|attempts| {
        let rows: BTreeSet<usize> = attempts.into_iter().map(|(row, _)| row).collect();
        let ids = rows.into_iter().map(|row| entries[row].id.as_str());
        Vec::from_iter(ids)
    });
    of_one.filter(|ids| ids.len() > 1).collect()
}

fn sanitized(text: &str) -> String {
    sanitize_line(text, MAX_CHARS)
}
