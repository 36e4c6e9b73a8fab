//! Formats one element of a submitted or an expected answer in full.

use protocol::{Answer, AnyTable, ElementOutcome, Record, ResultText, Tree};

use crate::describe::{fill, number, point, uv};
use crate::exam::{ExamQuestion, Key, Surface};
use crate::judge::table::ExpectedTable;
use crate::sanitize::sanitize;

/// Maximum length of a panic message, in characters.
const MAX_PANIC_CHARS: usize = 2_000;

/// Maximum number of nodes to show for a tree. More would bury the rest of a report.
const MAX_NODES: usize = 40;

/// Formats a submission's answer to one element of a question.
pub fn got(answer: &Answer, element: usize) -> String {
    match answer {
        Answer::Tree(built) => outcome(Some(built), tree),
        Answer::Picture(picture) => outcome(Some(picture), |pixels| match pixels.get(element) {
            Some(pixel) => point(*pixel),
            None => format!("{} pixels", pixels.len()),
        }),
        Answer::Rays(_)
        | Answer::Hits(_)
        | Answer::Spans(_)
        | Answer::Directions(_)
        | Answer::OptionalDirections(_)
        | Answer::Scattered(_)
        | Answer::Colors(_)
        | Answer::Densities(_)
        | Answer::Fractions(_) => {
            let rows = answer.rows().unwrap_or_default();
            outcome(rows.get(element), |record| {
                returned(answer.result_text(), *record)
            })
        }
    }
}

/// Formats what a function returned for one row of a table.
fn returned(text: Option<ResultText>, record: Option<&dyn Record>) -> String {
    match (text, record) {
        (Some(text), Some(record)) => fill(text.record, &[record]),
        (Some(text), None) => text.absent.to_owned(),
        (None, _) => String::new(),
    }
}

/// Formats whether a function returned something for one row of a table.
pub(crate) fn presence(table: &dyn AnyTable, record: Option<&dyn Record>) -> String {
    match record {
        Some(record) => fill(table.result_text().present, &[record]),
        None => table.result_text().absent.to_owned(),
    }
}

/// Formats the correct answer to one element of a question, or all correct answers if there are
/// several.
pub fn wanted(question: &ExamQuestion, element: usize) -> Vec<String> {
    match &question.key {
        Key::Table { rows, .. } => {
            let text = question.question.table().map(AnyTable::result_text);
            vec![returned(text, rows.record(element).as_deref())]
        }
        Key::FirstHits { hits, alternatives } => {
            let alternatives = alternatives
                .iter()
                .filter(|(position, _)| *position as usize == element);
            let all = std::iter::once(&hits[element]).chain(alternatives.map(|(_, answer)| answer));
            all.map(|answer| answer.as_ref().map_or("no hit".to_owned(), surface))
                .collect()
        }
        Key::Tree { checks, sweep_cost } => {
            let cost = sweep_cost.map(|cost| format!("its SAH cost is about {cost:.2}"));
            let checks = checks.iter().map(|check| check.requirement().to_owned());
            let all: Vec<String> = checks.chain(cost).collect();
            vec![format!("a tree in which {}", all.join(", and "))]
        }
        Key::Radiance { pixels, .. } => vec![point(pixels[element])],
        Key::SpreadEvenly { .. } => vec!["directions that are spread evenly".to_owned()],
    }
}

/// Formats the quantities of the correct answer that are compared, for an element without an answer
/// to compare them with.
pub fn judged(question: &ExamQuestion, element: usize) -> String {
    let row = ExpectedTable::new(question).and_then(|table| {
        let (record, _) = table.rows.get(element)?;
        let record = record.as_deref()?;
        let quantities = table.judged.iter().map(|quantity| quantity.text(record));
        let quantities: Vec<(String, String)> = quantities.collect();
        Some(match &quantities[..] {
            [(_, value)] if record.names().len() == 1 => value.clone(),
            all => {
                let all = all.iter().map(|(name, value)| format!("{name} {value}"));
                all.collect::<Vec<_>>().join(", ")
            }
        })
    });
    row.unwrap_or_else(|| wanted(question, element).join(", or "))
}

fn outcome<T>(outcome: Option<&ElementOutcome<T>>, show: impl Fn(&T) -> String) -> String {
    match outcome {
        Some(ElementOutcome::Value(value)) => show(value),
        Some(ElementOutcome::Panicked(panic)) => sanitize(
            &format!("a panic at {}: {}", panic.location, panic.message),
            MAX_PANIC_CHARS,
        ),
        Some(ElementOutcome::Skipped) | None => "no answer".to_owned(),
    }
}

fn tree(tree: &Tree) -> String {
    let nodes = tree
        .nodes
        .iter()
        .enumerate()
        .take(MAX_NODES)
        .map(|(index, node)| {
            let (min, max) = (point(node.min), point(node.max));
            let below = if node.is_leaf() {
                format!("leaf with size {} and start {}", node.size, node.start)
            } else {
                format!("children {} and {}", node.l, node.r)
            };
            format!("\n  {index}: {min} to {max}, {below}")
        });
    let nodes: String = nodes.collect();
    let rest = match tree.nodes.len().saturating_sub(MAX_NODES) {
        0 => String::new(),
        rest => format!("\n  … and {rest} more nodes"),
    };
    format!("root {}{nodes}{rest}", tree.root)
}

fn surface(surface: &Surface) -> String {
    format!(
        "distance {}, normal {}, uv {}",
        number(surface.depth),
        point(surface.normal),
        uv(surface.uv)
    )
}
