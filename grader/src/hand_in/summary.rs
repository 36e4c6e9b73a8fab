//! The text about an archive: what it contains and what to do with it.

use std::fmt;

use judging::sanitize::sanitize_line;

use super::HandIn;
use crate::handed_out::{HandedOut, TaskFile, is_unwritten, own_lines, without_comments};
use crate::machine::printing::counted;
use crate::submission::TaskFileError;
use crate::workspace::display_path;

/// The maximum length of a compiler message, in characters.
const MAX_MESSAGE_CHARS: usize = 200;

impl fmt::Display for HandIn {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let archive = display_path(&self.archive);
        let count = self
            .submission
            .files
            .iter()
            .filter(|(_, text)| text.is_ok());
        let count = counted(count.count(), "file");
        writeln!(f, "\n  {archive}: {count}\n")?;
        for (file, text) in &self.original.files {
            writeln!(f, "  {:16}{}", file.name, self.state(file, text))?;
        }
        writeln!(f)?;
        for note in self.build.all_notes() {
            writeln!(f, "  note: {}", sanitize_line(note, usize::MAX))?;
        }
        if let Some(kept) = &self.kept {
            writeln!(
                f,
                "  note: the previous archive contained your work in {}. A copy of that archive is \
                 kept as {}.",
                kept.files.join(", "),
                display_path(&kept.copy)
            )?;
        }
        let given = given_files(self.original.handed_out);
        writeln!(
            f,
            "  You don't need to hand in anything else: {given} are provided."
        )?;
        writeln!(f, "\n  {}", self.next_step(&archive))
    }
}

impl HandIn {
    /// Describes the state of a file in the archive.
    fn state(&self, file: &TaskFile, text: &Result<String, TaskFileError>) -> String {
        let text = match text {
            Ok(text) => text,
            Err(TaskFileError::Missing) => return "missing".to_owned(),
            Err(error) => return format!("not in the archive: {}", error.message(file.name)),
        };
        let mut errors = self.build.not_compiled.iter();
        if let Some(error) = errors.find(|error| error.file == file.name) {
            let first = error.message.lines().next().unwrap_or_default();
            let first = sanitize_line(first, MAX_MESSAGE_CHARS);
            let line = error.line.map(|line| format!(" (line {line})"));
            return format!("does not compile: {first}{}", line.unwrap_or_default());
        }
        if is_unwritten(file, text) {
            return "unmodified".to_owned();
        }
        let lines = match own_lines(file, text).lines().count() {
            0 => "some of the starter's lines were removed, but you added none of your own"
                .to_owned(),
            count => format!("{} of your own", counted(count, "line")),
        };
        match line_with_todo(text) {
            Some(line) => format!("{lines}; still contains `todo!` (line {line})"),
            None => lines,
        }
    }

    /// Returns advice on what to do next with the archive.
    fn next_step(&self, archive: &str) -> String {
        if !self.is_started() {
            return "You haven't written anything yet: see handout/src/start.md.".to_owned();
        }
        let upload = format!("{archive} where your course collects this assignment.");
        if self.build.not_compiled.is_empty() {
            format!("Upload {upload}")
        } else {
            format!(
                "Fix these files (`cargo grade` shows the errors), then run `cargo handin` \
                 again.\n  If you are out of time, the other files still count: upload {upload}"
            )
        }
    }
}

/// Returns the number of the first line with a `todo!` outside a comment.
fn line_with_todo(text: &str) -> Option<usize> {
    let code = without_comments(text);
    let mut numbered = (1..).zip(code.lines());
    numbered.find_map(|(number, code)| code.contains("todo!(").then_some(number))
}

/// Returns the names of the given files as a list for use in a sentence.
fn given_files(handed_out: &HandedOut) -> String {
    let names: Vec<&str> = handed_out.given.iter().map(|file| file.name).collect();
    format!("{} and {}", names.join(", "), handed_out.main.name)
}
