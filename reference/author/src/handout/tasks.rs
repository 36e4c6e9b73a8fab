//! The generated parts of the handout: its lists of tasks and the contract of each task.

use std::path::Path;

use anyhow::{Context, Result};
use grader::files;
use grader::handed_out::HandedOut;
use judging::assignment::TaskInfo;
use judging::section::CHAPTERS;

use crate::coverage::contract;
use crate::generated_file::GeneratedFile;
use crate::handout::pages::Page;

/// The page with the book's table of contents, and the text above its list of tasks.
const CONTENTS: (&str, &str) = ("SUMMARY.md", "# The tasks\n\n");
/// The page with a table of the chapters, and the table's header.
const START: (&str, &str) = (
    "start.md",
    "| chapter | file | you write | points |\n|---|---|---|---|\n",
);
/// The page with a table of the tasks, and the table's header.
const GRADING: (&str, &str) = (
    "grading.md",
    "| task | file | method | points |\n|---|---|---|---|\n",
);
/// The beginning of a chapter's last line, which links to the next chapter.
const NEXT: &str = "Next: ";
/// The line below a task's contract.
const END_OF_CONTRACT: &str = "<!-- end of the contract -->";

/// Generates the chapters and the pages that list an assignment's tasks, for the workspace at
/// `root`. On each of these pages, only the list is replaced. In each chapter, two things are
/// replaced: the contract (the documentation of the method to write) and the link to the next
/// chapter.
pub fn generated_files(root: &Path, handed_out: &HandedOut) -> Result<Vec<GeneratedFile>> {
    let mut chapters: Vec<(&str, String)> = Vec::new();
    let (mut links, mut chapter_rows, mut task_rows) = (Vec::new(), Vec::new(), Vec::new());
    let tasks = handed_out.assignment.tasks;
    for task in tasks {
        let TaskInfo {
            id,
            file,
            methods,
            points,
            ..
        } = task;
        let link = link(root, task.chapter)?;
        let starter = handed_out.task_file(file).context("tasks have a file")?;
        let methods: Vec<String> = methods.iter().map(|path| format!("`{path}`")).collect();
        let methods = methods.join(", ");
        chapter_rows.push(format!("| {link} | `{file}` | {methods} | {points} |"));
        task_rows.push(format!("| `{id}` | `{file}` | {methods} | {points} |"));
        let known = chapters.iter().position(|(name, _)| *name == task.chapter);
        let index = known.unwrap_or(chapters.len());
        if known.is_none() {
            chapters.push((task.chapter, page(root, task.chapter)?));
            links.push(link);
        }
        for path in task.methods {
            let documentation = contract::documentation(starter.starter, path);
            let text = with_contract(&chapters[index].1, path, &documentation);
            chapters[index].1 = text.with_context(|| {
                format!(
                    "{} needs the lines {:?} and {END_OF_CONTRACT:?}",
                    task.chapter,
                    contract_of(path)
                )
            })?;
        }
    }
    task_rows.push(format!("| | | | **{}** |", handed_out.assignment.points()));

    let mut generated = Vec::new();
    for (index, (chapter, mut text)) in chapters.into_iter().enumerate() {
        if let Some(next) = links.get(index + 1) {
            let (before, _) = text
                .rsplit_once(NEXT)
                .with_context(|| format!("{chapter} has no line that begins with {NEXT:?}"))?;
            text = format!("{before}{NEXT}{next}.\n");
        }
        generated.push(GeneratedFile::new(format!("{CHAPTERS}/{chapter}"), text));
    }
    let links = links.iter().map(|link| format!("- {link}")).collect();
    for ((name, above), lines) in [
        (CONTENTS, links),
        (START, chapter_rows),
        (GRADING, task_rows),
    ] {
        let text = with_lines(&page(root, name)?, above, &lines);
        let text = text.with_context(|| format!("{name} does not contain {above:?}"))?;
        generated.push(GeneratedFile::new(format!("{CHAPTERS}/{name}"), text));
    }
    Ok(generated)
}

fn page(root: &Path, name: &str) -> Result<String> {
    Ok(files::read_to_string(root.join(CHAPTERS).join(name))?)
}

/// Returns a link to a chapter, with the chapter's first heading as the link's text.
fn link(root: &Path, chapter: &str) -> Result<String> {
    let headings = Page::new(chapter, &page(root, chapter)?).headings;
    let title = headings.first();
    let title = title.with_context(|| format!("{chapter} has no heading"))?;
    Ok(format!("[{}]({chapter})", title.text))
}

/// Replaces the lines between `above` and the next empty line.
fn with_lines(text: &str, above: &str, lines: &[String]) -> Option<String> {
    let (before, after) = text.split_once(above)?;
    let (_, after) = after.split_once("\n\n")?;
    Some(format!("{before}{above}{}\n\n{after}", lines.join("\n")))
}

/// Returns the line above a method's contract.
fn contract_of(method: &str) -> String {
    format!("<!-- generated from the documentation of {method} -->")
}

/// Replaces a method's contract in a chapter with the method's documentation. Links to other items
/// become plain names.
fn with_contract(text: &str, method: &str, documentation: &[&str]) -> Option<String> {
    let above = contract_of(method);
    let (before, after) = text.split_once(&above)?;
    let (_, after) = after.split_once(END_OF_CONTRACT)?;
    let lines = documentation
        .iter()
        .map(|line| line.strip_prefix(' ').unwrap_or(line));
    let contract = lines.collect::<Vec<_>>().join("\n");
    let contract = contract.replace("[`", "`").replace("`]", "`");
    Some(format!(
        "{before}{above}\nThe documentation of `{method}` says:\n\n{contract}\n{END_OF_CONTRACT}{after}"
    ))
}
