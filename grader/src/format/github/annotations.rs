//! Annotations: what is wrong, on the student's own file and line.

use crate::format::github::commands::command;
use crate::format::said::what;
use crate::format::size::cut;
use crate::format::{Around, Seen};
use crate::score::{FileReport, ItemScore, TaskScore, Verdict};

/// GitHub shows no more of a kind for one step.
const MOST: usize = 10;
/// The most characters of one.
const LONGEST: usize = 1_000;

/// Commands for standard output: the compiler's first error in each file, and of each other task
/// the first item that lost points.
pub fn annotations(seen: &Seen, around: &Around) -> String {
    let files = seen.now.build.not_compiled.iter();
    let files = files.map(|file| of_file(file, around));
    let tasks = seen.now.tasks.iter().filter_map(|task| {
        let item = task.items.iter().find(|item| is_told(&item.verdict))?;
        Some(of_item(task, item, around))
    });
    files.chain(tasks).take(MOST).collect()
}

fn of_file(file: &FileReport, around: &Around) -> String {
    let mut properties = vec![("file", path(&file.file, around))];
    properties.extend(file.line.map(|line| ("line", line.to_string())));
    properties.push(("title", format!("{} does not compile", file.file)));
    command("error", &properties, &cut(&file.message, LONGEST))
}

fn of_item(task: &TaskScore, item: &ItemScore, around: &Around) -> String {
    let at = item.at.as_ref();
    let file = at.map_or(task.id.file(), |at| &at.file);
    let line = at.map(|at| at.line);
    let line = line.or_else(|| around.methods.get(&task.id).copied());
    let mut properties = vec![("file", path(file, around))];
    properties.extend(line.map(|line| ("line", line.to_string())));
    let (points, of) = (task.points, task.max_points);
    properties.push(("title", format!("{}: {points} of {of} points", task.title)));
    let message = match what(item) {
        nothing if nothing.is_empty() => format!("{}: {}", item.id, item.title),
        what => format!("{}: {}\n{what}", item.id, item.title),
    };
    command("error", &properties, &cut(&message, LONGEST))
}

fn path(file: &str, around: &Around) -> String {
    match around.folder.as_str() {
        "" => file.to_owned(),
        folder => format!("{folder}/{file}"),
    }
}

/// Whether there is something to mend in the task's own file, which compiles.
fn is_told(verdict: &Verdict) -> bool {
    match verdict {
        Verdict::Partial
        | Verdict::Wrong
        | Verdict::Panicked
        | Verdict::Unimplemented
        | Verdict::TimedOut
        | Verdict::OutOfMemory
        | Verdict::Crashed
        | Verdict::Protocol => true,
        Verdict::Pass | Verdict::NotCompiled | Verdict::Blocked { .. } | Verdict::Pending => false,
    }
}
