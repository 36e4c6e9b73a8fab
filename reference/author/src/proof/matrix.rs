//! The table of the items that each mistake fails. Building the table also checks that every
//! mistake loses points where it must.

use std::fmt::Write;

use anyhow::{Result, bail};
use grader::score::ItemScore;
use judging::assignment::{Assignment, TaskInfo};
use judging::exam::{Exam, Item};

use crate::generated_file::GeneratedFile;
use crate::proof::grade::GradedSolution;
use crate::proof::run::run;
use crate::solutions::Solutions;
use crate::solutions::solution::Solution;

/// The path of the table, relative to the folder of an assignment's solutions.
const FILE: &str = "mistakes/matrix.md";

/// Builds the table for the practice exam. Returns an error if a mistake doesn't lose the points it
/// must lose.
pub fn generated_file(solutions: &Solutions, exam: &Exam) -> Result<GeneratedFile> {
    let (workbench, mistakes) = (&solutions.workbench, &solutions.mistakes);
    let graded = run(workbench, mistakes, "mistakes", |mistake, built| {
        GradedSolution::new(mistake, &built, exam)
    })?;
    let problems: Vec<String> = graded.iter().flat_map(GradedSolution::problems).collect();
    if !problems.is_empty() {
        bail!(
            "the practice exam and the mistakes do not agree; fix the items or the mistakes:\n{}",
            problems.join("\n")
        );
    }
    let handed_out = solutions.workbench.handed_out();
    let path = format!("{}/{FILE}", handed_out.solutions());
    let table = table(handed_out.assignment, exam, &graded);
    Ok(GeneratedFile::new(path, table))
}

/// Builds the table for one exam.
fn table(assignment: &Assignment, exam: &Exam, graded: &[GradedSolution]) -> String {
    let mut text = format!(
        "# Which mistake fails which item\n\n\
         Written by `cargo author mistakes` for {} known mistakes, each a change to the reference, \
         and the {} exam. ● means that all of the item's points are lost, ◐ that some are lost. \
         Parentheses mean that the mistake passes the item in some other exams. If an item of \
         another task would fail because of a mistake, it is graded with the reference's part (see \
         `handout/src/grading.md`), so that a mistake costs points in its own task only.\n",
        graded.len(),
        exam.id
    );
    for task in assignment.tasks() {
        let items: Vec<&Item> = exam.items.iter().filter(|item| item.task == task).collect();
        let of_task = |graded: &&GradedSolution| graded.solution.task() == task;
        let graded = graded.iter().filter(of_task);
        task_table(&mut text, assignment.info(task), &items, graded)
            .expect("writing to a String cannot fail");
    }
    text
}

fn task_table<'a>(
    out: &mut String,
    task: &TaskInfo,
    items: &[&Item],
    graded: impl Iterator<Item = &'a GradedSolution<'a>>,
) -> std::fmt::Result {
    writeln!(out, "\n## {}\n", task.title)?;
    for (number, item) in (1..).zip(items) {
        writeln!(out, "{number}. `{}`: {}", item.id, item.title)?;
    }
    let numbers: String = (1..=items.len())
        .map(|number| format!(" {number} |"))
        .collect();
    writeln!(out, "\n| mistake | what the code does | lost |{numbers}")?;
    writeln!(out, "|---|---|--:|{}", ":-:|".repeat(items.len()))?;
    for GradedSolution { solution, score } in graded {
        let of_task = |line: &&ItemScore| items.iter().any(|item| item.id == line.id);
        let lines: Vec<&ItemScore> = score.items().filter(of_task).collect();
        let lost: u32 = lines.iter().map(|line| line.max_points - line.points).sum();
        let cells = lines.iter().map(|line| cell(line, solution));
        let cells: String = cells.map(|cell| format!(" {cell} |")).collect();
        let name = solution.id.split('.').nth(1).unwrap_or_default();
        writeln!(out, "| `{name}` | {} | {lost} |{cells}", solution.title)?;
    }
    Ok(())
}

fn cell(line: &ItemScore, mistake: &Solution) -> &'static str {
    // The lists of failed items don't include items graded with the reference's parts.
    let is_certain = line.carried_forward || mistake.expected.fails.contains(&line.id);
    match (line.points, is_certain) {
        (points, _) if points == line.max_points => "",
        (0, true) => "●",
        (0, false) => "(●)",
        (_, true) => "◐",
        (_, false) => "(◐)",
    }
}
