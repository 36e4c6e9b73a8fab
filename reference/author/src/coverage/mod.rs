//! The coverage of the contract: each sentence of each task's documentation, and how often the exam
//! asks it at each scale, place, direction, start, size and history. A cell that is not asked has a
//! reason in `coverage.toml`, in the folder of the assignment's solutions.

mod cells;
mod contract;
mod list;

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::Result;
use grader::files;
use grader::handed_out::HandedOut;
use judging::assignment::TaskInfo;
use judging::exam::Exam;

use crate::generated_file::GeneratedFile;
use crate::solutions::read_toml;
use cells::Counts;
use list::{Listed, Sentence};

/// The list of sentences and reasons, relative to the folder of an assignment's solutions.
const SENTENCES: &str = "coverage.toml";
/// The table, relative to the same folder.
const TABLE: &str = "coverage.md";
/// The fewest questions of a cell, so that no mistake passes by luck.
const FEWEST: usize = 3;

/// The table, and what is wrong with it.
#[derive(Debug)]
pub struct Coverage {
    /// The table as a file.
    pub table: GeneratedFile,
    /// Sentences without items, items without sentences, and cells without questions and reasons,
    /// one line each.
    pub problems: Vec<String>,
    sentences: usize,
    asked: usize,
    excused: usize,
}

impl Coverage {
    /// Returns a one-line summary.
    pub fn summary_line(&self) -> String {
        format!(
            "sentences {}, cells asked {}, with a reason {}, missing {}",
            self.sentences,
            self.asked,
            self.excused,
            self.problems.len()
        )
    }
}

/// Determines the coverage of the contract by an exam.
pub fn coverage(root: &Path, handed_out: &HandedOut, exam: &Exam) -> Result<Coverage> {
    let folder = handed_out.solutions();
    let listed: Listed = read_toml(&root.join(folder).join(SENTENCES))?;
    let text = format!(
        "# Coverage of the contract\n\n\
         Written by `cargo author coverage` for the {} exam. Each row is a sentence of the \
         documentation of a method that students write; each number counts the answers that ask it \
         there. At least {FEWEST} must. A letter is the reason why fewer do, below the table.\n",
        exam.id
    );
    let mut coverage = Coverage {
        table: GeneratedFile::new(format!("{folder}/{TABLE}"), text),
        problems: Vec::new(),
        sentences: 0,
        asked: 0,
        excused: 0,
    };
    for task in handed_out.assignment.tasks {
        let file = files::read_to_string(root.join(handed_out.reference).join(task.file))?;
        coverage.add_task(task, &contract::sentences(&file, task), &listed, exam);
    }
    Ok(coverage)
}

impl Coverage {
    fn add_task(&mut self, task: &TaskInfo, sentences: &[String], listed: &Listed, exam: &Exam) {
        let of_task = |entry: &&Sentence| entry.task == task.id;
        let entries: Vec<&Sentence> = listed.sentence.iter().filter(of_task).collect();
        let unknown = entries
            .iter()
            .filter(|entry| !sentences.contains(&entry.text));
        self.problems.extend(
            unknown.map(|entry| format!("{SENTENCES}: {} does not say {:?}", task.id, entry.text)),
        );
        self.check_items(task, &entries, exam);

        let mut items = exam.items.iter().filter(|item| item.task == task.task());
        let first = items.next().and_then(|item| item.questions.first());
        let cells = first.map_or(Vec::new(), |asked| cells::of_task(&asked.question));
        let mut reasons: Vec<&str> = Vec::new();
        let mut rows = String::new();
        for sentence in sentences {
            self.sentences += 1;
            let Some(entry) = entries.iter().find(|entry| entry.text == *sentence) else {
                let problem = format!("{SENTENCES} has no entry for {}: {sentence:?}", task.id);
                self.problems.push(problem);
                continue;
            };
            rows += &format!("| {sentence} |");
            if let Some(why) = &entry.why_not {
                let why = letter(&mut reasons, why);
                rows += &format!(" {why} |{}\n", " |".repeat(cells.len()));
                continue;
            }
            let counts = counts(entry, exam);
            let items = entry.items.iter().map(|id| format!("`{}`", short(id)));
            rows += &format!(" {} |", items.collect::<Vec<_>>().join(", "));
            for cell in &cells {
                let count = cells::times(&counts, cell);
                let shown = if count >= FEWEST {
                    self.asked += 1;
                    count.to_string()
                } else if let Some(why) = listed.reason(task, entry, cell) {
                    self.excused += 1;
                    letter(&mut reasons, why)
                } else {
                    let task = task.id;
                    let problem = format!("{task}: {sentence:?} is asked {count} times at {cell}");
                    self.problems.push(problem);
                    format!("**{count}**")
                };
                rows += &format!(" {shown} |");
            }
            rows.push('\n');
        }
        self.table.contents += &format!(
            "\n## {}\n\n| sentence | items | {} |\n|---|---|{}\n{rows}",
            task.title,
            cells.join(" | "),
            "--:|".repeat(cells.len())
        );
        for (index, why) in reasons.iter().enumerate() {
            self.table.contents += &format!("\n- {}: {why}\n", name(index));
        }
    }

    /// Checks that every item of a task asks a sentence, and that every item exists.
    fn check_items(&mut self, task: &TaskInfo, entries: &[&Sentence], exam: &Exam) {
        let of_task = exam.items.iter().filter(|item| item.task.id() == task.id);
        let all: BTreeSet<&str> = of_task.map(|item| item.id.as_str()).collect();
        let asked = entries.iter().flat_map(|entry| &entry.items);
        let asked: BTreeSet<&str> = asked.map(String::as_str).collect();
        let unasked = all.difference(&asked);
        let unasked = unasked.map(|id| format!("{SENTENCES}: no sentence is asked by {id}"));
        let unknown = asked.difference(&all);
        let unknown = unknown.map(|id| format!("{SENTENCES}: there is no item {id}"));
        let unclear = |entry: &&&Sentence| entry.items.is_empty() == entry.why_not.is_none();
        let unclear = entries.iter().filter(unclear).map(|entry| {
            let text = &entry.text;
            format!("{SENTENCES}: {text:?} needs either items or why_not")
        });
        let problems = unasked.chain(unknown).chain(unclear);
        self.problems.extend(problems);
    }
}

fn counts(entry: &Sentence, exam: &Exam) -> Counts {
    let mut counts = Counts::new();
    let items = exam.items.iter();
    let items = items.filter(|item| entry.items.contains(&item.id));
    for question in items.flat_map(|item| &item.questions) {
        cells::count(question, &mut counts);
    }
    counts
}

fn short(id: &str) -> &str {
    id.split('.').next_back().unwrap_or(id)
}

/// Returns the letter of a reason, which is added to the list if it is new.
fn letter<'a>(reasons: &mut Vec<&'a str>, why: &'a str) -> String {
    let known = reasons.iter().position(|other| *other == why);
    name(known.unwrap_or_else(|| {
        reasons.push(why);
        reasons.len() - 1
    }))
}

fn name(index: usize) -> String {
    char::from(b'a' + (index % 26) as u8).to_string()
}

#[cfg(test)]
mod tests {
    use grader::handed_out::RAYS;
    use judging::exam::Item;

    use super::*;
    use crate::items;

    fn problems(keep: impl Fn(&Item) -> bool) -> Vec<String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let exam = items::exam_of_boxes().filter_items(keep);
        let all = coverage(&root, &RAYS, &exam)
            .expect("the list can be read")
            .problems;
        all.into_iter()
            .filter(|line| line.contains("bbox"))
            .collect()
    }

    #[test]
    fn a_sentence_that_is_no_longer_asked_is_a_problem() {
        let asked: Vec<String> = problems(|_| true);
        let without = problems(|item| item.id != "bbox.flat");
        let new: Vec<&String> = without
            .iter()
            .filter(|line| !asked.contains(line))
            .collect();
        assert!(
            new.iter()
                .any(|line| line.ends_with("there is no item bbox.flat")),
            "{new:?}"
        );
        let not_asked = "is asked 0 times at scale: one";
        assert!(new.iter().any(|line| line.ends_with(not_asked)), "{new:?}");
    }
}
