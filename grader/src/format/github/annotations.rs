//! Annotations, which GitHub shows next to lines of the student's own files.

use crate::format::github::commands::command;
use crate::format::item_text::item_message;
use crate::format::size::truncate;
use crate::format::{FormatContext, StudentView};
use crate::score::{FileReport, ItemScore, TaskScore, Verdict, VerdictKind};

/// The maximum number of annotations of one kind that GitHub shows per step.
const MAX_ANNOTATIONS: usize = 10;
/// The maximum number of characters in an annotation.
const MAX_CHARS: usize = 1_000;

/// Returns commands for standard output that annotate the first compiler error in each file and,
/// for each task whose file compiles, the first item for which there is something to fix in that
/// file.
pub fn annotations(view: &StudentView, context: &FormatContext) -> String {
    let files = view.visible.build.not_compiled.iter();
    let files = files.map(|file| file_annotation(file, context));
    let tasks = view.visible.tasks.iter().filter_map(|task| {
        let item = task.items.iter().find(|item| is_annotated(&item.verdict))?;
        Some(item_annotation(task, item, context))
    });
    files.chain(tasks).take(MAX_ANNOTATIONS).collect()
}

fn file_annotation(file: &FileReport, context: &FormatContext) -> String {
    let mut properties = vec![("file", checkout_path(&file.file, context))];
    properties.extend(file.line.map(|line| ("line", line.to_string())));
    properties.push(("title", format!("{} does not compile", file.file)));
    command("error", &properties, &truncate(&file.message, MAX_CHARS))
}

fn item_annotation(task: &TaskScore, item: &ItemScore, context: &FormatContext) -> String {
    let at = item.at.as_ref();
    let file = at.map_or(context.file_of(task.id), |at| &at.file);
    let line = at.map(|at| at.line);
    let line = line.or_else(|| context.methods.get(&task.id)?.line);
    let mut properties = vec![("file", checkout_path(file, context))];
    properties.extend(line.map(|line| ("line", line.to_string())));
    let (points, of) = (task.points, task.max_points);
    properties.push(("title", format!("{}: {points} of {of} points", task.title)));
    let message = match item_message(item) {
        empty if empty.is_empty() => format!("{}: {}", item.id, item.title),
        message => format!("{}: {}\n{message}", item.id, item.title),
    };
    command("error", &properties, &truncate(&message, MAX_CHARS))
}

fn checkout_path(file: &str, context: &FormatContext) -> String {
    match context.folder.as_str() {
        "" => file.to_owned(),
        folder => format!("{folder}/{file}"),
    }
}

/// Returns whether a verdict means that the task's own file compiles and contains something to fix.
fn is_annotated(verdict: &Verdict) -> bool {
    matches!(
        verdict.kind(),
        VerdictKind::Failed | VerdictKind::Unwritten | VerdictKind::NoAnswer
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::tests::sample;

    /// There is one annotation for a file that doesn't compile, and one for each task that can be
    /// fixed independently.
    #[test]
    fn the_first_mistake_of_each_task_is_annotated() {
        insta::assert_snapshot!(annotations(&sample::open(), &sample::context()));
    }

    #[test]
    fn a_perfect_submission_is_not_annotated() {
        let perfect = sample::view(&sample::perfect_score(), "", 0);
        assert_eq!(annotations(&perfect, &sample::context()), "");
    }

    #[test]
    fn files_at_the_top_of_the_checkout_have_no_folder() {
        let mut context = sample::context();
        assert_eq!(checkout_path("bvh.rs", &context), "student/src/bvh.rs");
        context.folder.clear();
        assert_eq!(checkout_path("bvh.rs", &context), "bvh.rs");
    }

    #[test]
    fn an_item_without_a_message_is_annotated_with_its_title() {
        let policy = "[visibility]\npractice = 'points'";
        let view = sample::view(&sample::score(), policy, 0);
        let annotations = annotations(&view, &sample::context());
        let camera = annotations.lines().nth(1).unwrap();
        assert!(
            camera.ends_with("::camera.unit_length: unit length"),
            "{camera}"
        );
    }

    #[test]
    fn no_more_is_annotated_than_github_shows() {
        let mut score = sample::score();
        let file = score.build.not_compiled[0].clone();
        score.build.not_compiled = vec![file; 20];
        let annotations = annotations(&sample::view(&score, "", 0), &sample::context());
        assert_eq!(annotations.lines().count(), MAX_ANNOTATIONS);
    }
}
