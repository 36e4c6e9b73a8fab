//! Canvas's gradebook. Its importer takes whatever stands in a column, creates assignments whose
//! title it does not know, and drops some columns in silence: so the teacher's own export is the
//! template, and of it only one column and those that tell people apart go back.

use std::path::Path;

use super::{
    FilledGradebook, GradebookSpec, MatchKey, column_key, fill, maximum_warning, non_empty,
    require_column,
};
use crate::entry::Person;
use crate::model::GradedClass;
use crate::table::{Table, TableError};

const REMEDY: &str = "export the gradebook from Canvas (Grades, Export), and name that file";
/// The last of the columns that are about people.
const SECTION: &str = "Section";
/// In whose row the maximum stands.
const POINTS_POSSIBLE: &str = "Points Possible";
/// Titles with these are dropped by Canvas without a word.
const IGNORED_TITLES: [&str; 9] = [
    "Current Score",
    "Current Points",
    "Current Grade",
    "Final Score",
    "Final Points",
    "Final Grade",
    "Override Score",
    "Override Grade",
    "Override Status",
];

/// The gradebook at `path`, with the class's points in the column that is meant.
pub fn fill_canvas(
    path: &Path,
    meant: Option<&str>,
    class: &GradedClass,
) -> Result<FilledGradebook, TableError> {
    let table = Table::read(path)?;
    let student = require_column(&table, path, "Student", REMEDY)?;
    let id = require_column(&table, path, "ID", REMEDY)?;
    let section = require_column(&table, path, SECTION, REMEDY)?;
    let target = find_target(&table, section, path, meant)?;
    let title = table.header[target].clone();
    let columns: Vec<usize> = (0..=section).chain([target]).collect();
    let table = table.select_columns(&columns);
    let target = columns.len() - 1;

    let possible = table
        .rows
        .iter()
        .find(|row| row[student].trim() == POINTS_POSSIBLE);
    let warning = possible.and_then(|row| maximum_warning(class, &row[target]));
    let sis = ["SIS User ID", "SIS Login ID"].map(|name| table.column(name));
    let mut keys = vec![column_key(id, |person| non_empty(&person.number))];
    keys.extend(sis[0].map(|column| column_key(column, |person| non_empty(&person.sid))));
    keys.extend(sis[1].map(|column| column_key(column, logins)));
    keys.push(MatchKey {
        row_text: Box::new(move |row| given_name_first(&row[student])),
        person_texts: |person| non_empty(&person.name),
    });
    let mut filled = fill(
        GradebookSpec {
            title: format!("Canvas, {title}"),
            table,
            target,
            keys,
            // Rows such as the maximum's have no number.
            is_person: &|row| !row[id].trim().is_empty() && row[student].trim() != POINTS_POSSIBLE,
            is_locked: &|_| false,
            name: &|row| row[student].clone(),
        },
        class,
    );
    filled.warnings.extend(warning);
    Ok(filled)
}

/// The column that is meant; the only one there can be, if none is named.
fn find_target(
    table: &Table,
    section: usize,
    path: &Path,
    meant: Option<&str>,
) -> Result<usize, TableError> {
    let names = table.header.iter().enumerate().skip(section + 1);
    let names: Vec<(usize, &str)> = names.map(|(place, name)| (place, name.trim())).collect();
    let is_dropped = |name: &str| IGNORED_TITLES.iter().any(|dropped| name.contains(dropped));
    let is_meant = |name: &str| match meant {
        Some(meant) => {
            name == meant
                || without_assignment_number(name) == meant
                || assignment_number(name) == meant
        }
        None => !assignment_number(name).is_empty(),
    };
    let found: Vec<(usize, &str)> = names
        .into_iter()
        .filter(|(_, name)| is_meant(name))
        .collect();
    let lacks = |remedy: String| TableError::MissingColumn {
        path: path.to_owned(),
        column: meant.unwrap_or("that must be the assignment's").to_owned(),
        remedy,
    };
    match found.as_slice() {
        [(_, name)] if is_dropped(name) => Err(lacks(format!(
            "Canvas ignores columns that are called like {name:?}: rename the assignment"
        ))),
        [(place, _)] => Ok(*place),
        [] => Err(lacks(
            "name one of its titles with --column, or the number behind it".to_owned(),
        )),
        several => {
            let names: Vec<&str> = several.iter().map(|(_, name)| *name).collect();
            Err(lacks(format!(
                "name it with --column: {}",
                names.join("; ")
            )))
        }
    }
}

/// `123456` of `Path Tracer (123456)`; nothing of other titles.
fn assignment_number(title: &str) -> &str {
    let inner = title
        .strip_suffix(')')
        .and_then(|title| title.rsplit_once('('));
    let number = inner.map_or("", |(_, number)| number);
    match number.bytes().all(|byte| byte.is_ascii_digit()) {
        true => number,
        false => "",
    }
}

/// `Path Tracer` of `Path Tracer (123456)`.
fn without_assignment_number(title: &str) -> &str {
    match assignment_number(title) {
        "" => title,
        number => title[..title.len() - number.len() - 2].trim_end(),
    }
}

fn logins(person: &Person) -> Vec<String> {
    let mut logins = non_empty(&person.login);
    logins.extend(non_empty(&person.email));
    logins
}

/// `Jane Doe` of `Doe, Jane`.
fn given_name_first(name: &str) -> String {
    match name.split_once(',') {
        Some((last, first)) => format!("{} {}", first.trim(), last.trim()),
        None => name.to_owned(),
    }
}
