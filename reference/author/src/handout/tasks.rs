//! The handout's lists of tasks, generated from the assignment.

use std::path::Path;

use anyhow::{Context, Result, anyhow};
use grader::files;
use grader::handed_out::HandedOut;
use judging::assignment::TaskInfo;
use judging::section::CHAPTERS;

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

/// Generates the pages that list an assignment's tasks in the workspace at `root`. Only the list in
/// each page is replaced. A chapter also ends with a link to the next chapter.
pub fn generated_files(root: &Path, handed_out: &HandedOut) -> Result<Vec<GeneratedFile>> {
    let mut chapters: Vec<&str> = Vec::new();
    let (mut links, mut chapter_rows, mut task_rows) = (Vec::new(), Vec::new(), Vec::new());
    let tasks = handed_out.assignment.tasks;
    for task in tasks {
        let TaskInfo {
            id, file, points, ..
        } = task;
        let link = link(root, task.chapter)?;
        let starter = handed_out.task_file(file).context("tasks have a file")?;
        let method = handed_out.task_method(task.task(), starter.starter);
        let method = method.map_err(|why| anyhow!(why))?.name;
        chapter_rows.push(format!("| {link} | `{file}` | `{method}` | {points} |"));
        task_rows.push(format!("| `{id}` | `{file}` | `{method}` | {points} |"));
        if !chapters.contains(&task.chapter) {
            chapters.push(task.chapter);
            links.push(link);
        }
    }
    task_rows.push(format!("| | | | **{}** |", handed_out.assignment.points()));

    let nexts = chapters.iter().zip(&links[1..]).map(|(chapter, next)| {
        let text = page(root, chapter)?;
        let (before, _) = text
            .rsplit_once(NEXT)
            .with_context(|| format!("{chapter} has no line that begins with {NEXT:?}"))?;
        let text = format!("{before}{NEXT}{next}.\n");
        Ok(GeneratedFile::new(format!("{CHAPTERS}/{chapter}"), text))
    });
    let mut generated = nexts.collect::<Result<Vec<_>>>()?;
    let links = links.iter().map(|link| format!("- {link}")).collect();
    for ((name, above), lines) in [
        (CONTENTS, links),
        (START, chapter_rows),
        (GRADING, task_rows),
    ] {
        let text = with_lines(&page(root, name)?, above, &lines);
        let text = text.with_context(|| format!("{name} does not have {above:?}"))?;
        generated.push(GeneratedFile::new(format!("{CHAPTERS}/{name}"), text));
    }
    Ok(generated)
}

fn page(root: &Path, name: &str) -> Result<String> {
    Ok(files::read_to_string(root.join(CHAPTERS).join(name))?)
}

/// Returns a link to a chapter, with its first heading as the text.
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
