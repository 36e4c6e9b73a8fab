//! Messages to the people whose submissions cannot be graded or lack a file. They say what was wrong
//! and how to hand in again. Staff send the messages themselves: this program doesn't send anything.

use std::collections::BTreeSet;

use grader::handed_out::HandedOut;
use judging::sanitize::sanitize_line;

use crate::entry::Person;
use crate::error::Error;
use crate::graded_class::GradedClass;
use crate::identity::{Attempt, attempts_by_person};
use crate::names::{joined, unique_name};
use crate::outcome::EntryOutcome;
use crate::store::Store;

/// The subfolder of the output folder for the messages.
pub const FOLDER: &str = "hand-in-again";
/// The maximum length of a name or a reason, in characters.
const MAX_CHARS: usize = 1_000;

/// Writes a message to each person whose submissions cannot be graded or lack files. Removes the
/// messages from the last run. For each message, returns the indices of the submissions that it is
/// about.
pub fn write_messages(
    class: &GradedClass,
    store: &Store,
    handed_out: &HandedOut,
) -> Result<Vec<BTreeSet<usize>>, Error> {
    store.clear(FOLDER, ".txt")?;
    let mut used = BTreeSet::new();
    let mut messages = Vec::new();
    let people = class.rows.iter();
    let people = people.map(|row| row.result.info.people.as_slice());
    for mut attempts in attempts_by_person(people) {
        let grade = |(row, index): &Attempt| &class.rows[*row].grades[*index];
        let reason = |attempt: &Attempt| {
            let result = &class.rows[attempt.0].result;
            // Otherwise, staff have decided, or the student did nothing wrong.
            let mut manual = grade(attempt).manual.iter();
            let is_open = !result.info.needs_staff && manual.all(|own| own.delta == 0);
            let why = match &result.outcome {
                EntryOutcome::NothingToGrade(why) => Some(why.clone()),
                EntryOutcome::Graded(_) => {
                    let files = joined(result.missing_files(), ", ");
                    let why =
                        format!("these files are missing, so their tasks earn 0 points: {files}");
                    Some(why).filter(|_| !files.is_empty())
                }
                EntryOutcome::Fault(_) => None,
            };
            let from = &result.info.from;
            why.filter(|_| is_open).map(|why| format!("{from}: {why}"))
        };
        attempts.retain(|attempt| !grade(attempt).is_superseded());
        let reasons: Option<Vec<String>> = attempts.iter().map(reason).collect();
        if let (Some(reasons), [(row, index), ..]) = (reasons, attempts.as_slice()) {
            let person = &class.rows[*row].result.info.people[*index];
            let name = unique_name(&class.file_name(person), "", &mut used);
            let text = render(person, &reasons, handed_out);
            store.write(format!("{FOLDER}/{name}.txt"), text)?;
            messages.push(attempts.iter().map(|(row, _)| *row).collect());
        }
    }
    Ok(messages)
}

/// Renders the message that tells a person what could not be graded and how to hand in again.
pub fn render(person: &Person, reasons: &[String], handed_out: &HandedOut) -> String {
    let name = sanitize_line(person.display_name(), MAX_CHARS);
    let address = match (person.email.as_str(), person.login.as_str()) {
        ("", login) if login.is_empty() || login == person.display_name() => String::new(),
        ("", login) => format!(" ({})", sanitize_line(login, MAX_CHARS)),
        (email, _) => format!(" <{}>", sanitize_line(email, MAX_CHARS)),
    };
    let reason = |why: &String| format!("- {}\n", sanitize_line(why, MAX_CHARS));
    let (default, id) = (<&HandedOut>::default(), handed_out.assignment.id);
    let (option, archive) = if id == default.assignment.id {
        (String::new(), "handin.zip".to_owned())
    } else {
        (format!(" --assignment {id}"), format!("handin-{id}.zip"))
    };
    format!(
        "To: {name}{address}\n\
         Subject: Please resubmit your work\n\
         \n\
         Hello {name},\n\
         \n\
         There is a problem with your submission:\n\
         \n\
         {}\n\
         Please pack your files again. To do so, run this command in the assignment's folder:\n\
         \n    cargo handin{option}\n\
         \n\
         It creates the archive {archive} from your {}.\n\
         It also checks the archive the way the grader will and lists each file. If one is\n\
         missing, put it next to the others, with exactly the name listed, and run the\n\
         command again.\n\
         \n\
         Then send us {archive} in reply to this message. Your original submission time still\n\
         counts, so please hand in the same code as before, without changes.\n",
        reasons.iter().map(reason).collect::<String>(),
        handed_out.file_list(),
    )
}
