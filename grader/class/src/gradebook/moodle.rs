//! Moodle's grading worksheet. Moodle imports only the `Grade` column and the feedback, and matches
//! rows by the participant's number. Grades that can no longer be changed are left unchanged.

use std::path::Path;

use super::{
    FilledGradebook, GradebookSpec, KeyKind, MatchKey, column_key, fill, maximum_warning, non_empty,
};
use crate::error::Error;
use crate::graded_class::GradedClass;
use crate::table::Table;

const REMEDY: &str =
    "download the grading worksheet from the assignment's page (it must allow offline grading)";

const TRANSLATED: &str = "it is a grading worksheet in another language than English: switch Moodle \
    to English in its menu or in your preferences, and download it again";

/// Reads the worksheet at `path` and fills in the class's points.
pub fn fill_moodle(path: &Path, class: &GradedClass) -> Result<FilledGradebook, Error> {
    let table = Table::read(path)?;
    let remedy = if is_translated(&table) {
        TRANSLATED
    } else {
        REMEDY
    };
    let identifier = table.require_column(path, "Identifier", remedy)?;
    let target = table.require_column(path, "Grade", remedy)?;
    let name = table.column("Full name");
    let locked = table.column("Grade can be changed");
    let maximum = table.column("Maximum Grade");
    let maximum = maximum.and_then(|column| table.rows.first()?.get(column).cloned());
    let warning = maximum.and_then(|maximum| maximum_warning(class, &maximum));

    let mut keys = vec![MatchKey {
        kind: KeyKind::Number,
        row_text: Box::new(move |row| participant(&row[identifier])),
        person_texts: |person| non_empty(&person.number),
    }];
    let id_number = table.column("ID number");
    keys.extend(
        id_number.map(|column| column_key(KeyKind::Only, column, |person| non_empty(&person.sid))),
    );
    let email = table.column("Email address");
    keys.extend(email.map(|column| {
        column_key(KeyKind::OneOfSeveral, column, |person| {
            non_empty(&person.email)
        })
    }));
    keys.extend(
        name.map(|column| column_key(KeyKind::Name, column, |person| non_empty(&person.name))),
    );
    let is_locked =
        |row: &[String]| locked.is_some_and(|column| row[column].trim().eq_ignore_ascii_case("no"));
    let mut filled = fill(
        GradebookSpec {
            title: "Moodle".to_owned(),
            table,
            target,
            keys,
            is_person: &|row| !row[identifier].trim().is_empty(),
            is_locked: &is_locked,
            name: &|row| row[name.unwrap_or(identifier)].clone(),
        },
        class,
    );
    filled.warnings.extend(warning);
    Ok(filled)
}

/// Returns whether the table has a worksheet's first column, such as `Teilnehmer/in 123`, whatever its
/// head is. Moodle writes the heads in the language of the person who downloads it.
fn is_translated(table: &Table) -> bool {
    let is_numbered = |row: &Vec<String>| {
        let cell = row.first().map_or("", |cell| cell.trim());
        let number = cell.rsplit_once(|c: char| !c.is_ascii_digit());
        number.is_some_and(|(word, number)| {
            !number.is_empty() && word.chars().any(char::is_alphabetic)
        })
    };
    table.column("Identifier").is_none()
        && !table.rows.is_empty()
        && table.rows.iter().all(is_numbered)
}

/// Returns `123` for `Participant 123`, in any language of the site.
fn participant(identifier: &str) -> String {
    let number = identifier.trim().rsplit(|c: char| !c.is_ascii_digit());
    number.into_iter().next().unwrap_or_default().to_owned()
}
