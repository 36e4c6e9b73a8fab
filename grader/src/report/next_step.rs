//! The last line of the terminal report after a success, which says what to do next.

use judging::assignment::Assignment;
use judging::sanitize::sanitize;
use judging::section::Section;

use crate::build::RESTORE_LABEL;
use crate::build::compiler_help::SECTION_LABEL;
use crate::handed_out::ASSIGNMENTS;
use crate::inputs::task_selection::TaskSelection;
use crate::machine::printing::wrap;
use crate::report::failing_items::first_to_fix;
use crate::report::text::{HintDetail, MAX_WARNINGS, joined_hints};
use crate::sandbox::Isolation;
use crate::score::{CodeLocation, Score, TaskScore, Verdict, VerdictKind};

/// The width of the text to the right of the labels.
const TEXT_WIDTH: usize = 70;

/// Returns advice on what to do next, followed by an empty line, unless only tasks that aren't
/// complete yet were selected. The advice is only for students who grade their own work with the
/// practice exam.
pub fn next_step(score: &Score, selection: &TaskSelection, assignment: &Assignment) -> String {
    let is_own_work = score.rerun_command.exam.is_none() && score.isolation == Isolation::None;
    if !is_own_work {
        return String::new();
    }
    let is_complete = |task: &TaskScore| task.points == task.max_points;
    let tasks = score.tasks.iter();
    let mut selected = tasks.filter(|task| selection.includes(task.id));
    if !selection.is_all() && !selected.any(is_complete) {
        return String::new();
    }
    let not_compiled = &score.build.not_compiled;
    if let (true, Some(report)) = (selection.is_all(), not_compiled.first()) {
        let step = compile_step(score, &report.file, &report.message);
        return row(step.lines().next().unwrap_or_default());
    }
    let is_selected = |task: &TaskScore| selection.includes(task.id);
    match first_to_fix(score, is_selected) {
        Some((task, _)) => row(&title_and_chapter(task)),
        // The tasks that were not selected were not graded.
        None if !selection.is_all() => row("`cargo grade` shows what the other tasks need"),
        None => row(&after_all_points(assignment)),
    }
}

/// Returns text that names one thing to do next in the selected tasks and says where to do it.
pub fn first_step(
    score: &Score,
    selection: &TaskSelection,
    assignment: &Assignment,
    hints: HintDetail,
) -> String {
    let first = first_to_fix(score, |task| selection.includes(task.id));
    let Some((task, item)) = first else {
        return labelled(notes(score)) + &row(&after_all_points(assignment));
    };
    let info = assignment.info(task.id);
    let place = match &item.at {
        Some(at) => format!("{}:{}", at.file, at.line),
        None => place_of_method(task, item.called, info.file),
    };
    let step = match item.verdict.kind() {
        VerdictKind::Unwritten => {
            let unwritten = item
                .at
                .as_ref()
                .and_then(|at| method_at(score, assignment, at));
            let names = unwritten.unwrap_or_else(|| info.method_names("and"));
            format!("write {names} in {place}")
        }
        VerdictKind::NotCompiled => compile_step(score, info.file, &item.message),
        VerdictKind::Blocked => format!("{} {}", item.id, item.message),
        kind @ (VerdictKind::Passed
        | VerdictKind::Failed
        | VerdictKind::NoAnswer
        | VerdictKind::Pending) => {
            let called = item.called.map(|called| info.method_name(called));
            let names = called.unwrap_or_else(|| info.method_names("or"));
            // The mistake itself can be in code that this method calls or relies on.
            let result = if kind == VerdictKind::NoAnswer {
                "no answer"
            } else {
                "a wrong answer"
            };
            format!("find out why {names} gives {result} ({place})")
        }
    };
    let what = format!("{}: {}", item.id, item.message);
    // What is wrong can be something other than the item's title says, such as a miss instead of a
    // wrong normal.
    let title = (item.verdict.kind() == VerdictKind::Failed).then(|| item.title.clone());
    // The step for a file that doesn't compile already names a section, and the mistake behind a
    // blocked item isn't in this task.
    let has_section = !matches!(item.verdict, Verdict::NotCompiled | Verdict::Blocked { .. });
    let read = item.where_to_read().or(task.chapter.as_ref());
    let read = read.filter(|_| has_section);
    let hint = (!item.hints.is_empty()).then(|| joined_hints(&item.hints, hints));
    let rows = [
        ("next", Some(step)),
        ("goal", title),
        ("what", Some(what)),
        ("look", item.where_to_look().cloned()),
        ("hint", hint),
        ("read", read.map(Section::location)),
        ("again", Some(item.rerun_command(&score.rerun_command))),
    ];
    let rows = rows
        .into_iter()
        .filter_map(|(label, text)| Some((label, text?)));
    // They can explain the wrong answer, or show that the mistake is in another file.
    let warnings = task.relevant_warnings().iter().take(MAX_WARNINGS);
    let warnings = warnings.map(|warning| ("warning", warning.clone()));
    format!("\n{}", labelled(rows.chain(notes(score)).chain(warnings)))
}

/// Returns the file and the line of a task's method or, if it isn't known, of the task's first
/// method that isn't written yet.
fn place_of_method(task: &TaskScore, called: Option<&str>, file: &str) -> String {
    let mut methods = task.methods.iter();
    match methods.find(|(method, _)| Some(*method) == called) {
        Some((_, line)) => format!("{file}:{line}"),
        None => task.method.clone(),
    }
}

/// Returns the name of the method at this place: the last one that begins above it.
fn method_at(score: &Score, assignment: &Assignment, at: &CodeLocation) -> Option<String> {
    let infos = score
        .tasks
        .iter()
        .map(|task| (task, assignment.info(task.id)));
    let in_file = infos.filter(|(_, info)| info.file == at.file);
    let methods = in_file.flat_map(|(task, info)| {
        let methods = task.methods.iter();
        methods.map(move |(method, line)| (info, *method, *line))
    });
    let above = methods.filter(|(_, _, line)| *line <= at.line);
    let (info, method, _) = above.max_by_key(|(_, _, line)| *line)?;
    Some(info.method_name(method))
}

/// Returns the notes on the submission's files, with a label.
fn notes(score: &Score) -> impl Iterator<Item = (&'static str, String)> {
    let notes = score.build.all_notes();
    notes.map(|note| ("note", note.clone()))
}

/// Formats pairs of a label and a text as lines.
fn labelled(rows: impl Iterator<Item = (&'static str, String)>) -> String {
    let rows = rows.map(|(label, text)| {
        let lines = wrap(&sanitize(&text, usize::MAX), TEXT_WIDTH).join("\n          ");
        format!("  {label:<7} {lines}\n")
    });
    rows.collect()
}

/// Returns the step for a file that doesn't compile: its first error and, if any, the section that
/// explains it and what to restore.
fn compile_step(score: &Score, file: &str, message: &str) -> String {
    let mut files = score.build.not_compiled.iter();
    let Some(report) = files.find(|report| report.file == file) else {
        return format!("make {file} compile: {message}");
    };
    if report.is_missing {
        return format!(
            "{message}: if you have renamed it, change the name back. `cargo grade --reset {file}` \
             restores the original file"
        );
    }
    if report.line.is_none() && !report.message.contains('\n') {
        // The reason nothing was compiled, such as an empty file.
        return report.message.clone();
    }
    let line = report.line.map_or(String::new(), |line| format!(":{line}"));
    let error = report.message.lines().next().unwrap_or_default();
    // Later paragraphs are about other errors.
    let read = report.message.split("\n\n").nth(1);
    let read = read.filter(|read| read.starts_with(SECTION_LABEL));
    let read = read.map_or(String::new(), |read| format!("\n{read}"));
    let lines = report.message.lines();
    let restore = lines.skip_while(|line| !line.starts_with(RESTORE_LABEL));
    let restore: String = restore.map(|line| format!("\n{line}")).collect();
    format!("make {file}{line} compile: {error}{read}{restore}")
}

/// Returns a task's title and the handout's chapter about it, if any.
fn title_and_chapter(task: &TaskScore) -> String {
    match &task.chapter {
        Some(chapter) => format!("{}, {}", task.title, chapter.location()),
        None => task.title.clone(),
    }
}

/// Returns advice on what to do after completing the assignment.
fn after_all_points(assignment: &Assignment) -> String {
    let picture = assignment
        .render
        .map(|command| format!("`{command}` draws with your code"));
    let challenge = assignment
        .challenge
        .map(|section| Section::new(section).location());
    let steps = picture.into_iter().chain(challenge);
    let steps: Vec<String> = steps.chain(next_assignment(assignment)).collect();
    match steps.len() {
        0 => "`cargo handin` packs the files that you hand in".to_owned(),
        _ => steps.join("\n"),
    }
}

/// Says where the assignment after this one begins, if there is one.
fn next_assignment(assignment: &Assignment) -> Option<String> {
    let mut all = ASSIGNMENTS.iter().map(|handed_out| handed_out.assignment);
    all.find(|other| other.id == assignment.id)?;
    let next = all.next()?;
    let chapter = Section::new(next.tasks.first()?.chapter).location();
    Some(format!(
        "the next assignment, \"{}\", begins in {chapter}",
        next.title
    ))
}

fn row(text: &str) -> String {
    let lines: Vec<String> = text
        .lines()
        .flat_map(|line| wrap(line.trim(), TEXT_WIDTH))
        .collect();
    format!("  next    {}\n\n", lines.join("\n          "))
}
