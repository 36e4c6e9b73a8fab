//! The coverage of the contract: the items that ask each sentence of each task's documentation, and how
//! often the exam asks each class of each function's domain. What is not asked has a reason in
//! `coverage.toml`, in the folder of the assignment's solutions.

mod classes;
mod contract;
mod list;

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::Result;
use grader::files;
use judging::assignment::TaskInfo;
use judging::exam::Exam;

use crate::authoring::Authoring;
use crate::domains::Domain;
use crate::generated_file::GeneratedFile;
use crate::solutions::read_toml;
use classes::Classes;
use list::{Listed, Sentence};

/// The list of sentences and reasons, relative to the folder of an assignment's solutions.
const SENTENCES: &str = "coverage.toml";
/// The table, relative to the same folder.
const TABLE: &str = "coverage.md";
/// The fewest answers of a class, so that no mistake passes by luck.
const FEWEST: usize = 2;

/// The table, and what is wrong with it.
#[derive(Debug)]
pub struct Coverage {
    /// The table as a file.
    pub table: GeneratedFile,
    /// Sentences without items, items without sentences, and classes without questions and reasons,
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
            "sentences {}, classes asked {}, with a reason {}, missing {}",
            self.sentences,
            self.asked,
            self.excused,
            self.problems.len()
        )
    }
}

/// Determines the coverage of the contract by an exam.
pub fn coverage(root: &Path, authoring: &Authoring, exam: &Exam) -> Result<Coverage> {
    let handed_out = authoring.handed_out;
    let folder = handed_out.solutions();
    let listed: Listed = read_toml(&root.join(folder).join(SENTENCES))?;
    let text = format!(
        "# Coverage of the contract\n\n\
         Written by `cargo author coverage` for the {} exam. First, the sentences of the documentation \
         of the methods that students write, with the items that ask them. Then, for each function, how \
         many answers ask each class of its domain: those that are something, those that are `None`, \
         and those of which a quantity is judged. At least {FEWEST} must. A letter is the reason why \
         fewer do, below the table.\n",
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
    for domain in authoring.domains {
        coverage.add_function(*domain, &listed, exam);
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

        self.table.contents += &format!("\n## {}\n\n| sentence | items |\n|---|---|\n", task.title);
        for sentence in sentences {
            self.sentences += 1;
            let Some(entry) = entries.iter().find(|entry| entry.text == *sentence) else {
                let problem = format!("{SENTENCES} has no entry for {}: {sentence:?}", task.id);
                self.problems.push(problem);
                continue;
            };
            let items = entry.items.iter().map(|id| format!("`{}`", short(id)));
            let items = items.collect::<Vec<_>>().join(", ");
            let asked = entry.why_not.as_deref().unwrap_or(&items);
            self.table.contents += &format!("| {sentence} | {asked} |\n");
        }
    }

    fn add_function(&mut self, domain: &dyn Domain, listed: &Listed, exam: &Exam) {
        let function = domain.function();
        let classes = Classes::count(domain, exam);
        let mut reasons: Vec<&str> = Vec::new();
        let columns = &classes.columns;
        let mut rows = String::new();
        for (aspect, (name, names)) in domain.aspects().into_iter().enumerate() {
            for (class, class_name) in names.iter().enumerate() {
                rows += &format!("| {name} | {class_name} |");
                for column in columns {
                    let count = classes.times(aspect, class, column);
                    let reason = listed.reason(function, name, class_name, column);
                    let place = format!("{name} {class_name:?} for {column}");
                    let shown = self.shown(function, &place, count, reason, &mut reasons);
                    rows += &format!(" {shown} |");
                }
                rows.push('\n');
            }
        }
        self.check_pairs(domain, &classes, listed);
        self.table.contents += &format!(
            "\n## `{function}`\n\n| aspect | class | {} |\n|---|---|{}\n{rows}",
            columns.join(" | "),
            "--:|".repeat(columns.len())
        );
        for (index, why) in reasons.iter().enumerate() {
            self.table.contents += &format!("\n- {}: {why}\n", letter(index));
        }
    }

    /// Returns a count, or the letter of the reason why it is small. Without a reason, that is a problem.
    fn shown<'a>(
        &mut self,
        function: &str,
        place: &str,
        count: usize,
        reason: Option<&'a str>,
        reasons: &mut Vec<&'a str>,
    ) -> String {
        if count >= FEWEST {
            self.asked += 1;
            return count.to_string();
        }
        let Some(why) = reason else {
            let problem = format!("{function} is asked {count} times at {place}");
            self.problems.push(problem);
            return format!("**{count}**");
        };
        self.excused += 1;
        let known = reasons.iter().position(|other| *other == why);
        letter(known.unwrap_or_else(|| {
            reasons.push(why);
            reasons.len() - 1
        }))
    }

    /// Checks that each pair of classes of two aspects about shape is asked.
    fn check_pairs(&mut self, domain: &dyn Domain, classes: &Classes, listed: &Listed) {
        const COLUMN: &str = "pairs";
        let (function, aspects) = (domain.function(), domain.aspects());
        let find = |name: &str| aspects.iter().position(|aspect| aspect.0 == name);
        for [first, second] in domain.pairs() {
            let (Some(a), Some(b)) = (find(first), find(second)) else {
                self.problems
                    .push(format!("{function} has no aspects {first} and {second}"));
                continue;
            };
            for (i, class) in aspects[a].1.iter().enumerate() {
                for (j, other) in aspects[b].1.iter().enumerate() {
                    let count = classes.times_together([(a, i), (b, j)]);
                    let reason = listed.reason(function, first, class, COLUMN);
                    let reason = reason.or_else(|| listed.reason(function, second, other, COLUMN));
                    match (count, reason) {
                        (1.., _) => self.asked += 1,
                        (0, Some(_)) => self.excused += 1,
                        (0, None) => self.problems.push(format!(
                            "{function} is never asked at {first} {class:?} with {second} {other:?}"
                        )),
                    }
                }
            }
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

fn short(id: &str) -> &str {
    id.split('.').next_back().unwrap_or(id)
}

fn letter(index: usize) -> String {
    char::from(b'a' + (index % 26) as u8).to_string()
}

#[cfg(test)]
mod tests {
    use judging::exam::Item;

    use super::*;
    use crate::authoring::RAYS;
    use crate::items;

    fn problems(keep: impl Fn(&Item) -> bool) -> Vec<String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let exam = items::exam_of_boxes().filter_items(keep);
        let all = coverage(&root, &RAYS, &exam)
            .expect("the list can be read")
            .problems;
        all.into_iter()
            .filter(|line| line.contains("bbox") || line.contains("BBox"))
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
        let not_asked = "BBox::hit is asked 0 times at form \"flat along x\" for some";
        assert!(new.iter().any(|line| line.as_str() == not_asked), "{new:?}");
    }
}
