//! Composes the output of `--dry-run`: the files that would be graded for each student.

use std::collections::BTreeSet;

use grader::handed_out::HandedOut;

use crate::entry::{Entry, Person};
use crate::identity::{attempts_by_person, distinct_name};
use crate::input::collect_submission;
use crate::layout::{RecognisedClass, UnmatchedPath};
use crate::names::joined;
use crate::report::text::sentence;
use grader::printing::counted;

/// Renders each entry and the files that would be graded for it.
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
        let who = sentence(&entry.info.display_names());
        let late = if entry.info.is_late() { ", late" } else { "" };
        let (files, from) = (sentence(&files), sentence(&entry.info.from));
        text += &format!("  {who}{late}: {files}\n      {from}\n");
    }
    for ids in several_of_one_person(&class.entries) {
        let ids = joined(ids.into_iter().map(sentence), " and ");
        text += &format!(
            "\n  {ids} belong to the same person: remove all but one, or let the policy choose one \
             with [attempts]\n"
        );
    }
    text += &render_warnings(class);
    if !missing.is_empty() {
        text += "\n  on a roster, but without a submission:\n";
    }
    for person in missing {
        let people = class.entries.iter().flat_map(|entry| &entry.info.people);
        let name = distinct_name(person, people.chain(missing));
        text += &format!("      {}\n", sentence(&name));
    }
    let count = class.entries.len();
    text + &format!("\n  {gradable} of {count} can be graded\n\n")
}

/// Renders the problems that the teacher has to resolve. They are part of the preview and are also
/// printed after grading, since the grades don't show them.
pub fn render_warnings(class: &RecognisedClass) -> String {
    let mut text = String::new();
    for note in &class.notes {
        text += &format!("\n  {}\n", sentence(note));
    }
    if !class.unmatched.is_empty() {
        text += "\n  not part of any submission:\n";
    }
    for UnmatchedPath { name, why } in &class.unmatched {
        text += &format!("      {}: {}\n", sentence(name), sentence(why));
    }
    text
}

fn describe_files(entry: &Entry, handed_out: &'static HandedOut) -> Result<String, String> {
    let collected = collect_submission(entry, handed_out);
    let submission = collected.map_err(|outcome| outcome.why().to_owned())?;
    let missing = submission.files.iter();
    let missing = missing.filter_map(|(file, text)| Some(text.as_ref().err()?.message(file.name)));
    let missing: Vec<String> = missing.collect();
    let (count, missing_count) = (submission.files.len(), missing.len());
    let mut text = match missing.join("; ").as_str() {
        "" if submission.is_as_handed_out() => format!("all {count} files, unmodified"),
        "" => format!("all {count} files"),
        missing => format!("{} of {count} files; {missing}", count - missing_count),
    };
    for note in &submission.ignored_copies {
        text += &format!("; {note}");
    }
    Ok(text)
}

/// For each person with several entries, returns the ids of these entries.
fn several_of_one_person(entries: &[Entry]) -> BTreeSet<Vec<&str>> {
    let people = entries.iter().map(|entry| entry.info.people.as_slice());
    let of_one = attempts_by_person(people).into_iter().map(|attempts| {
        let rows: BTreeSet<usize> = attempts.into_iter().map(|(row, _)| row).collect();
        let ids = rows.into_iter().map(|row| entries[row].id.as_str());
        Vec::from_iter(ids)
    });
    of_one.filter(|ids| ids.len() > 1).collect()
}
