//! Writes the handout's lists of tasks, checks the handout's links, names and commands against the
//! code, and builds the handout as a book.

#[cfg(feature = "book")]
pub mod book;
pub mod commands;
pub mod gallery;
pub mod links;
pub mod names;
pub mod pages;
pub mod tasks;

use std::collections::BTreeSet;
use std::path::Path;

use grader::build::compiler_help;
use grader::files::{self, PathError};
use judging::assignment::{Assignment, TaskClues};
use judging::exam::Exam;
use judging::section::{CHAPTERS, Section};

use crate::handout::names::KnownNames;
use crate::handout::pages::{Page, pages};

/// The folders to search for names used in the handout. They contain the code students see, and the
/// code that writes files students see.
const SOURCES: [&str; 11] = [
    "student/src",
    "student/protocol/src",
    "student/framework/src",
    "student/light/src",
    "reference/src",
    "grader/src",
    "grader/judging/src",
    "grader/class/src",
    "grader/view/src",
    "reference/author/src/items",
    "scenes",
];

/// Folders that aren't searched for files.
const IGNORED_FOLDERS: [&str; 2] = [".git", "target"];

/// A source file to search for names.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// The path relative to the workspace's root, with `/` as the separator.
    pub path: String,
    /// The complete text of the file.
    pub text: String,
}

/// Returns all problems with the handout of the workspace at `root`: broken links, references from
/// the exam to missing sections, and unknown names and commands.
pub fn problems(
    root: &Path,
    assignment: &Assignment,
    exam: &Exam,
) -> Result<Vec<String>, PathError> {
    let pages = pages(&root.join(CHAPTERS))?;
    let (files, mut sources) = (files(root)?, sources(root)?);
    let config = SourceFile {
        path: ".cargo/config.toml".to_owned(),
        text: files::read_to_string(root.join(".cargo/config.toml"))?,
    };
    let aliases = aliases(&config.text);
    sources.push(config);
    let known = KnownNames {
        sources: &sources,
        files: &files,
        exam,
    };

    let mut all = links::broken_links(&pages, &figures(&files));
    all.extend(links::missing_sections(
        &pages,
        exam,
        other_sections(assignment),
    ));
    all.extend(pages.iter().flat_map(|page: &Page| {
        let mut problems = names::unknown_names(page, &known);
        problems.extend(commands::unknown_commands(page, &sources, &aliases));
        problems
    }));
    Ok(all)
}

/// Returns the sections that are referred to from outside an exam. Each comes with a description of
/// what refers to it, for use in messages.
fn other_sections(assignment: &Assignment) -> impl Iterator<Item = (String, Section)> {
    let challenge = assignment.challenge.into_iter();
    let challenge = challenge.map(|section| ("the challenge".to_owned(), Section::new(section)));
    let clues = assignment.tasks.iter().flat_map(|task| {
        let TaskClues {
            section_if_stack_overflows,
            sections_on_crashes,
            sections_on_panics,
            section_on_kept_state,
            by_symptom,
            if_nothing_is_hit: _,
            if_stack_overflows: _,
        } = &task.clues;
        let single = section_if_stack_overflows
            .iter()
            .chain(section_on_kept_state);
        let on_panics = sections_on_panics.iter().map(|(_, section)| section);
        let on_faults = single.chain(*sections_on_crashes).chain(on_panics);
        let of_faults = on_faults.map(|section| {
            let whose = format!("a clue for {} (fault)", task.id);
            (whose, Section::new(*section))
        });
        let of_symptoms = by_symptom.iter().map(|clue| {
            let whose = format!("a clue for {} ({})", task.id, clue.symptoms[0].what);
            (whose, Section::new(clue.section))
        });
        of_faults.chain(of_symptoms)
    });
    let errors = compiler_help::sections().map(|section| ("a compiler error".to_owned(), section));
    challenge.chain(clues).chain(errors)
}

/// Returns the paths of the figures, relative to the chapters' folder.
fn figures(files: &BTreeSet<String>) -> BTreeSet<String> {
    let chapters = format!("{CHAPTERS}/");
    let names = files.iter().filter_map(|file| file.strip_prefix(&chapters));
    let figures = names.filter(|name| name.starts_with("figures/"));
    figures.map(str::to_owned).collect()
}

/// Returns the names of the aliases in cargo's configuration.
fn aliases(config: &str) -> BTreeSet<String> {
    let below = config.lines().skip_while(|line| *line != "[alias]");
    let names = below.filter_map(|line| line.split_once(" = "));
    names.map(|(name, _)| name.to_owned()).collect()
}

fn sources(root: &Path) -> Result<Vec<SourceFile>, PathError> {
    let mut sources = Vec::new();
    for folder in SOURCES {
        for path in files_below(root, &root.join(folder))? {
            let code = [".rs", ".json"].iter().any(|ending| path.ends_with(ending));
            if code {
                let text = files::read_to_string(root.join(&path))?;
                sources.push(SourceFile { path, text });
            }
        }
    }
    Ok(sources)
}

fn files(root: &Path) -> Result<BTreeSet<String>, PathError> {
    Ok(files_below(root, root)?.into_iter().collect())
}

/// Returns the paths of all files below a folder, relative to the root, with `/` as the separator.
fn files_below(root: &Path, folder: &Path) -> Result<Vec<String>, PathError> {
    let mut found = Vec::new();
    for path in files::read_dir(folder)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if IGNORED_FOLDERS.contains(&&*name) {
            continue;
        }
        if path.is_dir() {
            found.extend(files_below(root, &path)?);
        } else if let Ok(path) = path.strip_prefix(root) {
            found.push(path.to_string_lossy().replace('\\', "/"));
        }
    }
    Ok(found)
}
