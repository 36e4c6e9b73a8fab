//! The generated parts of the handout: the lists of an assignment's tasks and chapters, and the
//! contract of each task.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use grader::files;
use grader::handed_out::HandedOut;
use judging::assignment::TaskInfo;
use judging::section::CHAPTERS;

use crate::coverage::contract;
use crate::generated_file::GeneratedFile;
use crate::handout::links::SUMMARY;
use crate::handout::pages::Page;

/// The first page about an assignment, which is in the folder of its chapters, and the header of the
/// page's table of tasks.
const START: (&str, &str) = (
    "start.md",
    "| chapter | task | file | you write | points |\n|---|---|---|---|---|\n",
);
/// The beginning of a chapter's last line, which links to the next chapter.
const NEXT: &str = "Next: ";
/// The line below a task's contract.
const END_OF_CONTRACT: &str = "<!-- end of the contract -->";

/// Generates the chapters and the pages that list an assignment's tasks, for the workspace at
/// `root`. Two lists are replaced: the chapters in the table of contents, below the assignment's
/// first page, and the table of tasks on that page. In each chapter, two things are replaced: the
/// contract (the documentation of the methods to write) and the link to the next chapter.
pub fn generated_files(root: &Path, handed_out: &HandedOut) -> Result<Vec<GeneratedFile>> {
    let mut chapters: Vec<(&str, String)> = Vec::new();
    let (mut titles, mut rows) = (Vec::new(), Vec::new());
    let tasks = handed_out.assignment.tasks;
    let folder = folder(tasks.first().map_or("", |task| task.chapter));
    for task in tasks {
        let TaskInfo {
            id,
            file,
            methods,
            points,
            chapter,
            ..
        } = task;
        let name = chapter.strip_prefix(folder);
        let name = name.with_context(|| format!("{chapter} must be in the folder {folder:?}"))?;
        let title = title(root, chapter)?;
        let starter = handed_out.task_file(file).context("tasks have a file")?;
        let methods: Vec<String> = methods.iter().map(|path| format!("`{path}`")).collect();
        let methods = methods.join(", ");
        rows.push(format!(
            "| [{title}]({name}) | `{id}` | `{file}` | {methods} | {points} |"
        ));
        let known = chapters.iter().position(|(known, _)| known == chapter);
        let index = known.unwrap_or(chapters.len());
        if known.is_none() {
            chapters.push((chapter, page(root, chapter)?));
            titles.push((title, name));
        }
        for path in task.methods {
            let documentation = contract::documentation(starter.starter, path);
            // The starter is part of this program, so its file may be newer.
            ensure!(
                !documentation.is_empty(),
                "{file} in the starter does not document {path}: run `cargo author starter`, then \
                 this command again"
            );
            let text = with_contract(&chapters[index].1, path, &documentation);
            chapters[index].1 = text.with_context(|| {
                format!(
                    "{chapter} needs the lines {:?} and {END_OF_CONTRACT:?}",
                    contract_of(path)
                )
            })?;
        }
    }
    rows.push(format!(
        "| | | | | **{}** |",
        handed_out.assignment.points()
    ));

    let mut generated = Vec::new();
    for (index, (chapter, mut text)) in chapters.into_iter().enumerate() {
        if let Some((title, name)) = titles.get(index + 1) {
            let (before, _) = text
                .rsplit_once(NEXT)
                .with_context(|| format!("{chapter} has no line that begins with {NEXT:?}"))?;
            text = format!("{before}{NEXT}[{title}]({name}).\n");
        }
        generated.push(GeneratedFile::new(format!("{CHAPTERS}/{chapter}"), text));
    }
    let contents = titles.iter();
    let contents = contents.map(|(title, name)| format!("- [{title}]({folder}{name})"));
    let start = format!("{folder}{}", START.0);
    for (name, above, lines) in [
        (SUMMARY, &*format!("]({start})\n"), contents.collect()),
        (&start, START.1, rows),
    ] {
        let text = with_lines(&page(root, name)?, above, &lines);
        let text = text.with_context(|| format!("{name} does not contain {above:?}"))?;
        generated.push(GeneratedFile::new(format!("{CHAPTERS}/{name}"), text));
    }
    Ok(generated)
}

/// Returns the folder of a chapter, with a slash at the end, or an empty string if the chapter isn't
/// in a folder.
fn folder(chapter: &str) -> &str {
    let end = chapter.rfind('/').map_or(0, |slash| slash + 1);
    &chapter[..end]
}

fn page(root: &Path, name: &str) -> Result<String> {
    Ok(files::read_to_string(root.join(CHAPTERS).join(name))?)
}

/// Returns the title of a chapter, which is its first heading.
fn title(root: &Path, chapter: &str) -> Result<String> {
    let headings = Page::new(chapter, &page(root, chapter)?).headings;
    let title = headings.into_iter().next();
    let title = title.with_context(|| format!("{chapter} has no heading"))?;
    Ok(title.text)
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

#[cfg(test)]
mod tests {
    use grader::handed_out::{RAYS, TaskFile};
    use judging::assignment::{Assignment, TaskClues};

    use super::*;

    const fn task(
        id: &'static str,
        methods: &'static [&'static str],
        chapter: &'static str,
    ) -> TaskInfo {
        TaskInfo {
            id,
            title: "",
            file: "material.rs",
            methods,
            points: 50,
            chapter,
            clues: TaskClues::NONE,
        }
    }

    static ASSIGNMENT: Assignment = Assignment {
        tasks: &[
            task("matte", &["evaluate"], "light/matte.md"),
            task("glass", &["reflect", "refract"], "light/glass.md"),
        ],
        ..judging::assignment::RAYS
    };
    const FILES: &[TaskFile] = &[TaskFile {
        name: "material.rs",
        starter: "/// One.\npub fn evaluate() {}\n\n/// Two.\npub fn reflect() {}\n\n\
                  /// Three.\npub fn refract() {}\n",
        required_declarations: &[],
    }];

    #[test]
    fn an_assignment_in_a_folder_has_its_own_lists_and_its_links_are_relative() {
        let root = tempfile::tempdir().unwrap();
        let empty = |method| format!("{}\n{END_OF_CONTRACT}", contract_of(method));
        let says = |method, text| {
            format!(
                "{}\nThe documentation of `{method}` says:\n\n{text}\n{END_OF_CONTRACT}",
                contract_of(method)
            )
        };
        let rays = "# Rays\n\n- [Start](start.md)\n- [Camera](camera.md)\n\n";
        let light = "# Light\n\n- [Start](light/start.md)\n";
        let header = START.1;
        // The name of each page, its text, and the expected text.
        let pages = [
            (
                "light/matte.md",
                format!("# Matte\n{}\nNext: nothing\n", empty("evaluate")),
                format!(
                    "# Matte\n{}\nNext: [Glass](glass.md).\n",
                    says("evaluate", "One.")
                ),
            ),
            (
                "light/glass.md",
                format!("# Glass\n{}\n{}\n", empty("reflect"), empty("refract")),
                format!(
                    "# Glass\n{}\n{}\n",
                    says("reflect", "Two."),
                    says("refract", "Three.")
                ),
            ),
            (
                SUMMARY,
                format!("{rays}{light}\n\n# End\n"),
                format!(
                    "{rays}{light}- [Matte](light/matte.md)\n- [Glass](light/glass.md)\n\n# End\n"
                ),
            ),
            (
                "light/start.md",
                format!("{header}\n\nText.\n"),
                format!(
                    "{header}| [Matte](matte.md) | `matte` | `material.rs` | `evaluate` | 50 |\n\
                     | [Glass](glass.md) | `glass` | `material.rs` | `reflect`, `refract` | 50 |\n\
                     | | | | | **100** |\n\nText.\n"
                ),
            ),
        ];
        let expected = pages.map(|(name, before, after)| {
            let path = format!("{CHAPTERS}/{name}");
            files::write_with_parents(root.path().join(&path), &before).unwrap();
            GeneratedFile::new(path, after)
        });
        let handed_out = HandedOut {
            assignment: &ASSIGNMENT,
            files: FILES,
            ..RAYS
        };
        let generated = generated_files(root.path(), &handed_out).unwrap();
        assert_eq!(generated, expected);
    }
}
