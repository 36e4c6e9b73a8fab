//! The exam's coverage of the contract: the items that test each sentence of each task's
//! documentation, and how often the exam tests each class of each function's domain. Anything
//! untested needs a reason, which is declared next to the task's items or the function's domain.

pub mod contract;

use std::path::Path;

use anyhow::{Context, Result};
use grader::files;
use judging::assignment::TaskInfo;
use judging::exam::Exam;

use crate::authoring::Authoring;
use crate::domains::Domain;
use crate::domains::classes::{Cell, Classes, FEWEST};
use crate::generated_file::GeneratedFile;
use crate::items::{AuthoredTask, Declaration};

/// The path of the table, relative to the folder that contains an assignment's solutions.
const TABLE: &str = "coverage.md";

/// The table and its problems.
#[derive(Debug)]
pub struct Coverage {
    /// The table as a file.
    pub table: GeneratedFile,
    /// Sentences without items, items without sentences, and classes with neither questions nor a
    /// reason, one line each.
    pub problems: Vec<String>,
    sentences: usize,
    asked: usize,
    excused: usize,
}

impl Coverage {
    /// Returns a one-line summary.
    pub fn summary_line(&self) -> String {
        format!(
            "{} sentences; classes: {} tested, {} left untested for a stated reason; problems: {}",
            self.sentences,
            self.asked,
            self.excused,
            self.problems.len()
        )
    }
}

/// Determines how an exam covers the contract.
pub fn coverage(root: &Path, authoring: &Authoring, exam: &Exam) -> Result<Coverage> {
    let handed_out = authoring.handed_out;
    let folder = handed_out.solutions();
    let text = format!(
        "# Coverage of the contract\n\n\
         Written by `cargo author coverage` for the {} exam. For each task, a table lists the \
         sentences in the documentation of the methods that students write, along with the items \
         that test each sentence. Then, for each function, a table divides the inputs into classes \
         and shows how many answers test each class. The columns count the answers that contain a \
         result (`some`), the answers that are `None`, and the answers that test each judged \
         quantity. Each class needs at least {FEWEST} answers in every column. If there are fewer, \
         a letter takes the place of the number and refers to a reason below the table.\n",
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
        let authored = authored_task(task.id, authoring.tasks)?;
        let file = files::read_to_string(root.join(handed_out.reference).join(task.file))?;
        coverage.add_task(task, &contract::sentences(&file, task), authored);
    }
    for domain in authoring.tasks.iter().flat_map(|task| task.domains) {
        coverage.add_function(*domain, exam);
    }
    Ok(coverage)
}

/// Returns the authored task that contains the items of the task with this id.
fn authored_task(id: &str, tasks: &[&'static AuthoredTask]) -> Result<&'static AuthoredTask> {
    let is_of_task = |item: &Declaration| item.id.split_once('.').is_some_and(|it| it.0 == id);
    let mut tasks = tasks.iter().copied();
    let found = tasks.find(|task| task.items.iter().any(is_of_task));
    found.with_context(|| {
        format!("the task `{id}` has no items: add one whose id begins with `{id}.`")
    })
}

impl Coverage {
    fn add_task(&mut self, task: &TaskInfo, sentences: &[String], authored: &AuthoredTask) {
        let tested = authored.items.iter().flat_map(|item| {
            let name = item.id.split('.').next_back().unwrap_or(item.id);
            let asked = format!("`{name}`");
            item.tests.iter().map(move |text| (*text, asked.clone()))
        });
        let untested = authored.untested.iter();
        let untested = untested.map(|(text, why)| (*text, (*why).to_owned()));
        let (tested, untested): (Vec<_>, Vec<_>) = (tested.collect(), untested.collect());

        for (text, asked) in tested.iter().chain(&untested) {
            if sentences.iter().filter(|it| is_meant(text, it)).count() != 1 {
                let problem = format!(
                    "{}: {asked}: {text:?} must match exactly one sentence: quote it up to its \
                     full stop, or only its beginning, followed by an ellipsis (…)",
                    task.id
                );
                self.problems.push(problem);
            }
        }
        let without = authored.items.iter().filter(|item| item.tests.is_empty());
        let without = without.map(|item| {
            format!(
                "{} doesn't test any sentence: quote at least one in its `tests`",
                item.id
            )
        });
        self.problems.extend(without);

        self.table.contents += &format!("\n## {}\n\n| sentence | items |\n|---|---|\n", task.title);
        for sentence in sentences {
            self.sentences += 1;
            let of_sentence = |list: &[(&str, String)]| -> Vec<String> {
                let meant = list.iter().filter(|(text, _)| is_meant(text, sentence));
                meant.map(|(_, asked)| asked.clone()).collect()
            };
            let (items, reasons) = (of_sentence(&tested), of_sentence(&untested));
            if items.is_empty() == reasons.is_empty() {
                let problem = format!("{}: {sentence:?} needs either items or a reason", task.id);
                self.problems.push(problem);
            }
            let asked = [items, reasons].concat().join(", ");
            self.table.contents += &format!("| {sentence} | {asked} |\n");
        }
    }

    fn add_function(&mut self, domain: &dyn Domain, exam: &Exam) {
        let function = domain.function();
        let classes = Classes::count(domain, &exam.items);
        let mut reasons: Vec<&str> = Vec::new();
        let columns = &classes.columns();
        let mut rows = String::new();
        for cells in classes.cells(domain).chunks(columns.len().max(1)) {
            rows += &format!("| {} | {} |", cells[0].aspect, cells[0].class);
            for cell in cells {
                rows += &format!(" {} |", self.shown(function, cell, &mut reasons));
            }
            rows.push('\n');
        }
        for pair in classes.pairs(domain) {
            let [(first, class), (second, other)] = pair.classes;
            if pair.is_missing() {
                self.problems.push(format!(
                    "{function} is never tested with {first} {class:?} and {second} {other:?}"
                ));
            } else if pair.count > 0 {
                self.asked += 1;
            } else {
                self.excused += 1;
            }
        }
        self.table.contents += &format!(
            "\n## `{function}`\n\n| aspect | class | {} |\n|---|---|{}\n{rows}",
            columns.join(" | "),
            "--:|".repeat(columns.len())
        );
        for (index, why) in reasons.iter().enumerate() {
            self.table.contents += &format!("\n- {}: {why}\n", letter(index));
        }
    }

    /// Formats a count, or the letter of the reason if the count is small. A small count without a
    /// reason is a problem.
    fn shown(&mut self, function: &str, cell: &Cell, reasons: &mut Vec<&'static str>) -> String {
        let count = cell.count;
        if count >= FEWEST {
            self.asked += 1;
            return count.to_string();
        }
        let Some(why) = cell.reason else {
            self.problems.push(format!(
                "{function} is tested {count} times at {} {:?} for {}",
                cell.aspect, cell.class, cell.column
            ));
            return format!("**{count}**");
        };
        self.excused += 1;
        let known = reasons.iter().position(|other| *other == why);
        letter(known.unwrap_or_else(|| {
            reasons.push(why);
            reasons.len() - 1
        }))
    }
}

/// Returns whether `text` is this sentence, or its beginning followed by an ellipsis.
fn is_meant(text: &str, sentence: &str) -> bool {
    match text.strip_suffix('…') {
        Some(beginning) => sentence.starts_with(beginning),
        None => sentence == text,
    }
}

fn letter(index: usize) -> String {
    char::from(b'a' + (index % 26) as u8).to_string()
}

#[cfg(test)]
mod tests {
    use judging::exam::Item;

    use super::*;
    use crate::authoring::{LIGHT, RAYS};
    use crate::items::{self, resolve};
    use crate::seed::Seed;

    /// Returns the coverage problems of a function in an exam that contains only some of the items
    /// of one task.
    fn problems(
        authoring: &Authoring,
        exam: &Exam,
        function: &str,
        keep: impl Fn(&Item) -> bool,
    ) -> Vec<String> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let exam = exam.clone().filter_items(keep);
        let coverage = coverage(&root, authoring, &exam).expect("the reference can be read");
        let mut all = coverage.problems;
        all.retain(|line| line.contains(function));
        all
    }

    #[test]
    fn a_class_that_is_no_longer_asked_is_a_problem() {
        let matte = authored_task("lambertian", LIGHT.tasks).expect("matte surfaces have items");
        let items = resolve(matte.draw(Seed(1), &[]));
        let exam_of_matte = Exam::new(LIGHT.handed_out.assignment, "test", items);
        let cases = [
            (
                &RAYS,
                items::exam_of_boxes(),
                "bbox.flat",
                "BBox::hit is tested 0 times at form \"flat along x\" for some",
            ),
            (
                &LIGHT,
                exam_of_matte,
                "lambertian.grazing",
                "Lambertian::pdf is tested 0 times at out \"1e-3 above\" for pdf",
            ),
        ];
        for (authoring, exam, left_out, expected) in cases {
            let function = expected.split_once(' ').expect("a sentence").0;
            let asked = problems(authoring, &exam, function, |_| true);
            let mut new = problems(authoring, &exam, function, |item| item.id != left_out);
            new.retain(|line| !asked.contains(line));
            assert!(new.iter().any(|line| line == expected), "{new:?}");
        }
    }

    #[test]
    fn a_task_is_found_by_the_ids_of_its_items() {
        let reversed: Vec<_> = RAYS.tasks.iter().rev().copied().collect();
        let found = authored_task("bbox", &reversed).expect("boxes have items");
        assert!(found.items[0].id.starts_with("bbox."));
        let error = authored_task("box", &reversed).expect_err("no task has this id");
        let expected = "the task `box` has no items: add one whose id begins with `box.`";
        assert_eq!(error.to_string(), expected);
    }

    #[test]
    fn a_sentence_needs_either_items_or_a_reason() {
        const BOX: Declaration = Declaration {
            id: "bbox.flat",
            tests: &["A flat box…", "Another sentence."],
            ..Declaration::ALONE
        };
        let authored = AuthoredTask {
            items: &[BOX],
            untested: &[("A flat box can be hit.", "a reason")],
            ..AuthoredTask::NEW
        };
        let mut coverage = Coverage {
            table: GeneratedFile::new("", ""),
            problems: Vec::new(),
            sentences: 0,
            asked: 0,
            excused: 0,
        };
        let task = RAYS.handed_out.assignment.find("bbox").expect("a task");
        let sentences = ["A flat box can be hit.", "Use `times`."].map(str::to_owned);
        coverage.add_task(task, &sentences, &authored);
        let expected = [
            "bbox: `flat`: \"Another sentence.\" must match exactly one sentence: quote it up to \
             its full stop, or only its beginning, followed by an ellipsis (…)",
            "bbox: \"A flat box can be hit.\" needs either items or a reason",
            "bbox: \"Use `times`.\" needs either items or a reason",
        ];
        assert_eq!(coverage.problems, expected);
    }
}
