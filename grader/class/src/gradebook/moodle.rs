//! Moodle's grading worksheet. Moodle only imports the `Grade` column and the feedback, and matches
//! rows by the participant's number. Locked grades are left unchanged.

use std::path::Path;

use super::{FilledGradebook, Gradebook, Key, KeyKind, fill};
use crate::error::Error;
use crate::graded_class::GradedClass;
use crate::names::number_at_end;
use crate::table::Table;

const REMEDY: &str =
    "download the grading worksheet from the assignment's page (it must allow offline grading)";

const TRANSLATED: &str = "the grading worksheet is in a language other than English: switch Moodle \
                          to English in its menu or your preferences, then download the worksheet \
                          again";

/// Reads the worksheet at `path` and fills in the class's points.
pub fn fill_moodle(path: &Path, class: &GradedClass) -> Result<FilledGradebook, Error> {
    let table = Table::read(path)?;
    let is_translated = is_translated(&table);
    let remedy = if is_translated { TRANSLATED } else { REMEDY };
    let identifier = table.require_column(path, "Identifier", remedy)?;
    let target = table.require_column(path, "Grade", remedy)?;
    let name = table.column("Full name");
    let keys = [
        (KeyKind::Number, "Identifier"),
        (KeyKind::Sid, "ID number"),
        (KeyKind::Email, "Email address"),
        (KeyKind::Name, "Full name"),
    ];
    let gradebook = Gradebook {
        title: "Moodle".to_owned(),
        target,
        keys: Key::of_columns(&table, &keys),
        names: vec![name.unwrap_or(identifier)],
        changeable: table.column("Grade can be changed"),
        maximum: table.first_cell("Maximum Grade"),
        table,
    };
    Ok(fill(gradebook, class))
}

/// Returns whether the table's first column looks like the first column of a worksheet, with cells
/// such as `Teilnehmer/in 123`. The header is ignored, since Moodle writes it in the language of
/// the person who downloads the worksheet.
fn is_translated(table: &Table) -> bool {
    let is_numbered = |row: &Vec<String>| {
        let cell = row.first().map_or("", |cell| cell.trim());
        let number = number_at_end(cell);
        let word = cell.strip_suffix(number).unwrap_or_default();
        // One letter isn't enough, because many student ids are a letter followed by a number.
        !number.is_empty() && word.chars().rev().skip(1).any(char::is_alphabetic)
    };
    table.column("Identifier").is_none()
        && !table.rows.is_empty()
        && table.rows.iter().all(is_numbered)
}
