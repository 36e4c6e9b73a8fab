//! Which mistake fails which item: a table for people, and the check that none goes unpunished.

use std::fmt::Write;

use grader::exam::{Exam, Item, Task};
use grader::score::ItemScore;

use crate::exams;
use crate::generated_file::GeneratedFile;
use crate::proof::graded_mistake::GradedMistake;
use crate::proof::solutions::{ProofError, Solutions};
use crate::proof::workbench::Workbench;

/// Where the table stands.
const PATH: &str = "reference/mistakes/matrix.md";

/// The table, of the practice exam that is committed. An error if a mistake is not judged as it
/// should be.
pub fn generated_file() -> Result<GeneratedFile, ProofError> {
    let exhibits = Solutions::load(Workbench::open()?)?;
    let exam = exams::load_practice(exhibits.workbench.root())?;
    let tried = exhibits.grade_mistakes(&exam)?;
    let problems: Vec<String> = tried.iter().flat_map(GradedMistake::problems).collect();
    if !problems.is_empty() {
        return Err(ProofError::Problems(problems));
    }
    Ok(table(&exam, &tried))
}

/// The table, of one exam.
fn table(exam: &Exam, tried: &[GradedMistake]) -> GeneratedFile {
    let mut text = format!(
        "# Which mistake fails which item\n\n\
         Written by `cargo author mistakes`: {} known mistakes, each a change to the reference, in \
         the {} exam. ● all of the item's points are lost, ◐ some of them. Where an item of another \
         task would fail, it is asked again with the reference's part (see `handout/src/grading.md`), \
         so one mistake costs its own task only.\n",
        tried.len(),
        exam.id
    );
    for task in Task::ALL {
        let items: Vec<&Item> = exam.items.iter().filter(|item| item.task == task).collect();
        let of_task = tried.iter().filter(|tried| tried.mistake.task() == task);
        task_table(&mut text, task, &items, of_task).expect("text takes text");
    }
    GeneratedFile::new(PATH, text)
}

fn task_table<'a>(
    out: &mut String,
    task: Task,
    items: &[&Item],
    tried: impl Iterator<Item = &'a GradedMistake<'a>>,
) -> std::fmt::Result {
    writeln!(out, "\n## {}\n", task.title())?;
    for (number, item) in (1..).zip(items) {
        writeln!(out, "{number}. `{}`: {}", item.id, item.title)?;
    }
    let numbers: String = (1..=items.len())
        .map(|number| format!(" {number} |"))
        .collect();
    writeln!(out, "\n| mistake | what such code does | lost |{numbers}")?;
    writeln!(out, "|---|---|--:|{}", ":-:|".repeat(items.len()))?;
    for GradedMistake { mistake, score } in tried {
        let lines: Vec<&ItemScore> = score
            .items()
            .filter(|line| items.iter().any(|item| item.id == line.id))
            .collect();
        let lost: u32 = lines.iter().map(|line| line.max_points - line.points).sum();
        let cells: String = lines
            .iter()
            .map(|line| format!(" {} |", cell(line)))
            .collect();
        let name = mistake.id.split('.').nth(1).unwrap_or_default();
        writeln!(out, "| `{name}` | {} | {lost} |{cells}", mistake.title)?;
    }
    Ok(())
}

fn cell(line: &ItemScore) -> &'static str {
    match line.points {
        points if points == line.max_points => "",
        0 => "●",
        _ => "◐",
    }
}
