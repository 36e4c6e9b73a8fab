//! Annotations: what is wrong, on the student's own file and line.

use crate::format::github::commands::command;
use crate::format::item_text::item_message;
use crate::format::size::truncate;
use crate::format::{FormatContext, StudentView};
use crate::score::{FileReport, ItemScore, TaskScore, Verdict};

/// GitHub shows no more of a kind for one step.
const MAX_ANNOTATIONS: usize = 10;
/// The most characters of one.
const MAX_CHARS: usize = 1_000;

/// Commands for standard output: the compiler's first error in each file, and of each other task
/// the first item that lost points.
pub fn annotations(seen: &StudentView, around: &FormatContext) -> String {
    let files = seen.visible.build.not_compiled.iter();
    let files = files.map(|file| file_annotation(file, around));
    let tasks = seen.visible.tasks.iter().filter_map(|task| {
        let item = task.items.iter().find(|item| is_annotated(&item.verdict))?;
        Some(item_annotation(task, item, around))
    });
    files.chain(tasks).take(MAX_ANNOTATIONS).collect()
}

fn file_annotation(file: &FileReport, around: &FormatContext) -> String {
    let mut properties = vec![("file", checkout_path(&file.file, around))];
    properties.extend(file.line.map(|line| ("line", line.to_string())));
    properties.push(("title", format!("{} does not compile", file.file)));
    command("error", &properties, &truncate(&file.message, MAX_CHARS))
}

fn item_annotation(task: &TaskScore, item: &ItemScore, around: &FormatContext) -> String {
    let at = item.at.as_ref();
    let file = at.map_or(task.id.file(), |at| &at.file);
    let line = at.map(|at| at.line);
    let line = line.or_else(|| around.method_lines.get(&task.id).copied());
    let mut properties = vec![("file", checkout_path(file, around))];
    properties.extend(line.map(|line| ("line", line.to_string())));
    let (points, of) = (task.points, task.max_points);
    properties.push(("title", format!("{}: {points} of {of} points", task.title)));
    let message = match item_message(item) {
        nothing if nothing.is_empty() => format!("{}: {}", item.id, item.title),
        what => format!("{}: {}\n{what}", item.id, item.title),
    };
    command("error", &properties, &truncate(&message, MAX_CHARS))
}

fn checkout_path(file: &str, around: &FormatContext) -> String {
    match around.folder.as_str() {
        "" => file.to_owned(),
        folder => format!("{folder}/{file}"),
    }
}

/// Whether there is something to mend in the task's own file, which compiles.
fn is_annotated(verdict: &Verdict) -> bool {
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
