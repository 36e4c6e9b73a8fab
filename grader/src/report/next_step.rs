//! The last line of the terminal report after a success, which says what to do next.

use judging::assignment::{Assignment, TaskInfo};
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
use crate::score::{CodeLocation, ItemScore, Score, TaskScore, Verdict, VerdictKind};

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
    let at = item.at.as_ref();
    let containing = at.and_then(|at| method_at(score, assignment, at));
    let step = match item.verdict.kind() {
        VerdictKind::Unwritten => writing_step(info, task, item, containing),
        VerdictKind::NotCompiled => compile_step(score, info.file, &item.message),
        VerdictKind::Blocked => format!("{} {}", item.id, item.message),
        VerdictKind::Passed
        | VerdictKind::Failed
        | VerdictKind::NoAnswer
        | VerdictKind::Pending => debugging_step(info, task, item, containing),
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
        ("view", item.view_command(&score.rerun_command)),
    ];
    let rows = rows
        .into_iter()
        .filter_map(|(label, text)| Some((label, text?)));
    // They can explain the wrong answer, or show that the mistake is in another file.
    let warnings = task.relevant_warnings().iter().take(MAX_WARNINGS);
    let warnings = warnings.map(|warning| ("warning", warning.clone()));
    format!("\n{}", labelled(rows.chain(notes(score)).chain(warnings)))
}

/// Returns the step for an item whose method still contains `todo!`. `containing` is the method that
/// contains the item's line, if it is known: its name, and whether it differs from the starter's
/// version.
fn writing_step(
    info: &TaskInfo,
    task: &TaskScore,
    item: &ItemScore,
    containing: Option<(String, bool)>,
) -> String {
    let Some(at) = &item.at else {
        return format!("write {} in {}", info.method_names("and"), task.method);
    };
    let place = format!("{}:{}", at.file, at.line);
    match (containing, item.called) {
        (Some((name, false)), _) => format!("write {name} in {place}"),
        (Some((name, true)), _) => format!("finish {name} in {place}"),
        // The line is in one of the student's own functions.
        (None, Some(called)) => format!("finish {} in {place}", info.method_name(called)),
        (None, None) => format!("finish {} in {place}", info.method_names("and")),
    }
}

/// Returns the step for an item with a wrong answer or without an answer. The mistake itself can be
/// in code that the named methods call or rely on. `containing` is as in [`writing_step`].
fn debugging_step(
    info: &TaskInfo,
    task: &TaskScore,
    item: &ItemScore,
    containing: Option<(String, bool)>,
) -> String {
    // A wrong answer has a symptom.
    let is_panic = item.verdict == Verdict::Panicked
        || (item.verdict == Verdict::Partial && item.symptom.is_none());
    let result = if is_panic {
        "panics"
    } else if item.verdict.kind() == VerdictKind::NoAnswer {
        "gives no answer"
    } else {
        "gives a wrong answer"
    };
    let called = item.called.map(|called| info.method_name(called));
    let called = called.unwrap_or_else(|| info.method_names("or"));
    if let Some(at) = item.at.as_ref().filter(|_| is_panic) {
        let name = containing.map_or(called, |(name, _)| name);
        return format!("find out why {name} {result} ({}:{})", at.file, at.line);
    }
    let position = |path: &str| {
        let mut methods = task.methods.iter();
        let method = methods.find(|method| method.path == path)?;
        Some(format!("{}:{}", info.file, method.line))
    };
    let own_position = item.called.and_then(position);
    // What a method returns also depends on what its type's constructor has prepared.
    let constructor = item.called.and_then(|called| info.constructor_of(called));
    if let Some(constructor) = constructor
        && let (Some(first), Some(second)) = (position(constructor), &own_position)
    {
        let constructor = info.method_name(constructor);
        return format!("find out why {constructor} ({first}) or {called} ({second}) {result}");
    }
    let place = own_position.as_ref().unwrap_or(&task.method);
    format!("find out why {called} {result} ({place})")
}

/// Returns the name of the method that contains this line, and whether it differs from the
/// starter's version.
fn method_at(score: &Score, assignment: &Assignment, at: &CodeLocation) -> Option<(String, bool)> {
    let tasks = score.tasks.iter();
    let mut methods = tasks.flat_map(|task| {
        let info = assignment.info(task.id);
        let methods = task.methods.iter().filter(|_| info.file == at.file);
        methods.map(move |method| (info, method))
    });
    let (info, method) =
        methods.find(|(_, method)| (method.line..=method.last_line).contains(&at.line))?;
    Some((info.method_name(method.path), method.is_changed))
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

#[cfg(test)]
mod tests {
    use judging::exam::Exam;
    use judging::exam_file::ExamName;
    use judging::symptom::Symptom;

    use super::*;
    use crate::handed_out::{LIGHT, MethodPosition};
    use crate::score::tests::small_exam::{boxes, item};
    use crate::verdict::pending_score;

    /// Returns the step for an item about environment maps whose failure `change` describes.
    fn step(change: impl FnOnce(&mut ItemScore)) -> String {
        let items = vec![item("environment.pdf", vec![boxes(1)])];
        let exam = Exam::new(LIGHT.assignment, "small", items);
        let name = ExamName {
            id: exam.id.clone(),
            hash: String::new(),
        };
        let mut score = pending_score(&exam, name, "ann", &LIGHT);
        let methods = [
            ("uniform_sphere", 10, 19, true),
            ("Environment::new", 30, 39, true),
            ("Environment::sample", 50, 59, false),
            ("Environment::pdf", 70, 79, true),
        ];
        let methods = methods.map(|(path, line, last_line, is_changed)| MethodPosition {
            path,
            line,
            last_line,
            is_changed,
        });
        score.tasks[0].methods = methods.into();
        change(&mut score.tasks[0].items[0]);
        let (task, item) = (&score.tasks[0], &score.tasks[0].items[0]);
        let info = LIGHT.assignment.info(task.id);
        let at = item.at.as_ref();
        let containing = at.and_then(|at| method_at(&score, LIGHT.assignment, at));
        if item.verdict == Verdict::Unimplemented {
            writing_step(info, task, item, containing)
        } else {
            debugging_step(info, task, item, containing)
        }
    }

    fn at(line: u32) -> Option<CodeLocation> {
        Some(CodeLocation {
            file: "environment.rs".to_owned(),
            line,
        })
    }

    #[test]
    fn a_panic_is_in_the_method_that_contains_the_line() {
        let panicked = |called, line: Option<u32>| {
            step(|item| {
                item.verdict = Verdict::Panicked;
                item.called = Some(called);
                item.at = line.and_then(at);
            })
        };
        let pdf = "Environment::pdf";
        for (step, expected) in [
            (
                panicked(pdf, Some(35)),
                "find out why `Environment::new` panics (environment.rs:35)",
            ),
            // The line is in one of the student's own functions.
            (
                panicked(pdf, Some(45)),
                "find out why `Environment::pdf` panics (environment.rs:45)",
            ),
            (
                panicked("uniform_sphere", None),
                "find out why `uniform_sphere` panics (environment.rs:10)",
            ),
        ] {
            assert_eq!(step, expected);
        }
    }

    #[test]
    fn a_wrong_answer_can_come_from_the_constructor() {
        let wrong = |called| {
            step(|item| {
                item.verdict = Verdict::Wrong;
                item.symptom = Some(Symptom::of("pdf"));
                item.called = Some(called);
            })
        };
        let expected = "find out why `Environment::new` (environment.rs:30) or `Environment::pdf` \
                        (environment.rs:70) gives a wrong answer";
        assert_eq!(wrong("Environment::pdf"), expected);
        let expected = "find out why `uniform_sphere` gives a wrong answer (environment.rs:10)";
        assert_eq!(wrong("uniform_sphere"), expected);
    }

    #[test]
    fn a_method_with_code_of_the_students_own_is_to_be_finished() {
        let unwritten = |line| {
            step(|item| {
                item.verdict = Verdict::Unimplemented;
                item.called = Some("Environment::pdf");
                item.at = at(line);
            })
        };
        for (line, expected) in [
            (55, "write `Environment::sample` in environment.rs:55"),
            (75, "finish `Environment::pdf` in environment.rs:75"),
            (45, "finish `Environment::pdf` in environment.rs:45"),
        ] {
            assert_eq!(unwritten(line), expected);
        }
    }
}
