//! The coverage of the contract: each sentence of each task's documentation, and how often the exam
//! asks it at each scale, place, direction, start, size and history. A cell that is not asked has a
//! reason in `reference/coverage.toml`.

mod cells;
mod contract;
mod list;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use anyhow::Result;
use grader::files;
use grader::handed_out::HandedOut;
use judging::assignment::TaskInfo;
use judging::exam::Exam;

use crate::generated_file::GeneratedFile;
use crate::solutions::toml_file::read_toml;
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
    let folder = root.join(handed_out.solutions());
    let listed: Listed = read_toml(&folder.join(SENTENCES))?;
    let mut coverage = Coverage {
        table: GeneratedFile::new(format!("{}/{TABLE}", handed_out.solutions()), String::new()),
        problems: Vec::new(),
        sentences: 0,
        asked: 0,
        excused: 0,
    };
    let mut text = format!(
        "# Coverage of the contract\n\n\
         Written by `cargo author coverage` for the {} exam. Each row is a sentence of the \
         documentation of a method that students write; each number counts the answers that ask it \
         there. At least {FEWEST} must. A letter is the reason why fewer do, below the table.\n",
        exam.id
    );
    for task in handed_out.assignment.tasks {
        let file = files::read_to_string(root.join(handed_out.reference).join(task.file))?;
        let sentences = contract::sentences(&file, task);
        coverage.add_task(&mut text, task, &sentences, &listed, exam);
    }
    coverage.table = GeneratedFile::new(format!("{}/{TABLE}", handed_out.solutions()), text);
    Ok(coverage)
}

impl Coverage {
    fn add_task(
        &mut self,
        text: &mut String,
        task: &TaskInfo,
        sentences: &[String],
        listed: &Listed,
        exam: &Exam,
    ) {
        let of_task = |entry: &&Sentence| entry.task == task.id;
        let entries: Vec<&Sentence> = listed.sentence.iter().filter(of_task).collect();
        let unknown = entries
            .iter()
            .filter(|entry| !sentences.contains(&entry.text));
        self.problems.extend(
            unknown.map(|entry| format!("{SENTENCES}: {} does not say {:?}", task.id, entry.text)),
        );
        self.check_items(task, &entries, exam);

        let cells = cells::of_task(task.id);
        let mut reasons: Vec<&str> = Vec::new();
        let mut rows = String::new();
        for sentence in sentences {
            self.sentences += 1;
            let Some(entry) = entries.iter().find(|entry| entry.text == *sentence) else {
                self.problems.push(format!(
                    "{SENTENCES} has no entry for {}: {sentence:?}",
                    task.id
                ));
                continue;
            };
            write!(rows, "| {sentence} |").expect("writing to a String cannot fail");
            if let Some(why) = &entry.why_not {
                write!(rows, " {} |", letter(&mut reasons, why)).expect("as above");
                rows.push_str(&" |".repeat(cells.len()));
                rows.push('\n');
                continue;
            }
            let counts = counts(entry, exam);
            let items: Vec<String> = entry
                .items
                .iter()
                .map(|id| format!("`{}`", short(id)))
                .collect();
            write!(rows, " {} |", items.join(", ")).expect("as above");
            for cell in &cells {
                let count = cells::times(&counts, cell);
                let why = listed.reason(task, entry, cell);
                match (count >= FEWEST, why) {
                    (true, _) => {
                        self.asked += 1;
                        write!(rows, " {count} |").expect("as above");
                    }
                    (false, Some(why)) => {
                        self.excused += 1;
                        write!(rows, " {} |", letter(&mut reasons, why)).expect("as above");
                    }
                    (false, None) => {
                        self.problems.push(format!(
                            "{}: {sentence:?} is asked {count} times at {cell}",
                            task.id
                        ));
                        write!(rows, " **{count}** |").expect("as above");
                    }
                }
            }
            rows.push('\n');
        }
        writeln!(text, "\n## {}\n", task.title).expect("as above");
        writeln!(text, "| sentence | items | {} |", cells.join(" | ")).expect("as above");
        writeln!(text, "|---|---|{}", "--:|".repeat(cells.len())).expect("as above");
        text.push_str(&rows);
        for (index, why) in reasons.iter().enumerate() {
            writeln!(text, "\n- {}: {why}", name(index)).expect("as above");
        }
    }

    /// Checks that every item of a task asks a sentence, and that every item exists.
    fn check_items(&mut self, task: &TaskInfo, entries: &[&Sentence], exam: &Exam) {
        let of_task = exam.items.iter().filter(|item| item.task.id() == task.id);
        let all: BTreeSet<&str> = of_task.map(|item| item.id.as_str()).collect();
        let asked = entries.iter().flat_map(|entry| &entry.items);
        let asked: BTreeSet<&str> = asked.map(String::as_str).collect();
        for id in all.difference(&asked) {
            self.problems
                .push(format!("{SENTENCES}: no sentence is asked by {id}"));
        }
        for id in asked.difference(&all) {
            self.problems
                .push(format!("{SENTENCES}: there is no item {id}"));
        }
        for entry in entries {
            if entry.items.is_empty() == entry.why_not.is_none() {
                let text = &entry.text;
                self.problems.push(format!(
                    "{SENTENCES}: {text:?} needs either items or why_not"
                ));
            }
        }
    }
}

fn counts(entry: &Sentence, exam: &Exam) -> Counts {
    let mut counts = Counts::new();
    let items = exam
        .items
        .iter()
        .filter(|item| entry.items.contains(&item.id));
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
    let index = reasons
        .iter()
        .position(|other| *other == why)
        .unwrap_or_else(|| {
            reasons.push(why);
            reasons.len() - 1
        });
    name(index)
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
    use crate::seed::Seed;

    fn problems(keep: impl Fn(&Item) -> bool) -> Vec<String> {
        let exam = Exam {
            schema: 1,
            assignment: RAYS.assignment.id.to_owned(),
            id: "test".to_owned(),
            mistakes: Vec::new(),
            items: items::resolve(items::bbox::items(Seed(1))),
        };
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let exam = exam.filter_items(keep);
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
