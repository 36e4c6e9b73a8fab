//! Canvas's gradebook. Its importer takes whatever stands in a column, creates assignments whose
//! title it does not know, and drops some columns in silence: so the teacher's own export is the
//! template, and of it only one column and those that tell people apart go back.

use std::path::Path;

use super::{Filled, Key, Shape, column, fill, key, known, maximum_warning};
use crate::entry::Person;
use crate::model::Class;
use crate::table::{BadTable, Table};

const REMEDY: &str = "export the gradebook from Canvas (Grades, Export), and name that file";
/// The last of the columns that are about people.
const LAST: &str = "Section";
/// In whose row the maximum stands.
const POSSIBLE: &str = "Points Possible";
/// Titles with these are dropped by Canvas without a word.
const DROPPED: [&str; 9] = [
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
pub fn canvas(path: &Path, meant: Option<&str>, class: &Class) -> Result<Filled, BadTable> {
    let table = Table::read(path)?;
    let student = column(&table, path, "Student", REMEDY)?;
    let id = column(&table, path, "ID", REMEDY)?;
    let section = column(&table, path, LAST, REMEDY)?;
    let target = target(&table, section, path, meant)?;
    let title = table.header[target].clone();
    let columns: Vec<usize> = (0..=section).chain([target]).collect();
    let table = table.only(&columns);
    let target = columns.len() - 1;

    let possible = table
        .rows
        .iter()
        .find(|row| row[student].trim() == POSSIBLE);
    let warning = possible.and_then(|row| maximum_warning(class, &row[target]));
    let sis = ["SIS User ID", "SIS Login ID"].map(|name| table.column(name));
    let mut keys = vec![key(id, |person| known(&person.number))];
    keys.extend(sis[0].map(|column| key(column, |person| known(&person.sid))));
    keys.extend(sis[1].map(|column| key(column, logins)));
    keys.push(Key {
        of_row: Box::new(move |row| plain_name(&row[student])),
        of_person: |person| known(&person.name),
    });
    let mut filled = fill(
        Shape {
            title: format!("Canvas, {title}"),
            table,
            target,
            keys,
            // Rows such as the maximum's have no number.
            is_person: &|row| !row[id].trim().is_empty() && row[student].trim() != POSSIBLE,
            is_locked: &|_| false,
            name: &|row| row[student].clone(),
        },
        class,
    );
    filled.warnings.extend(warning);
    Ok(filled)
}

/// The column that is meant; the only one there can be, if none is named.
fn target(
    table: &Table,
    section: usize,
    path: &Path,
    meant: Option<&str>,
) -> Result<usize, BadTable> {
    let names = table.header.iter().enumerate().skip(section + 1);
    let names: Vec<(usize, &str)> = names.map(|(place, name)| (place, name.trim())).collect();
    let is_dropped = |name: &str| DROPPED.iter().any(|dropped| name.contains(dropped));
    let is_meant = |name: &str| match meant {
        Some(meant) => name == meant || without_number(name) == meant || number(name) == meant,
        None => !number(name).is_empty(),
    };
    let found: Vec<(usize, &str)> = names
        .into_iter()
        .filter(|(_, name)| is_meant(name))
        .collect();
    let lacks = |remedy: String| BadTable::Lacks {
        path: path.to_owned(),
        lacks: meant.unwrap_or("that must be the assignment's").to_owned(),
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
fn number(title: &str) -> &str {
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
fn without_number(title: &str) -> &str {
    match number(title) {
        "" => title,
        number => title[..title.len() - number.len() - 2].trim_end(),
    }
}

fn logins(person: &Person) -> Vec<String> {
    let mut logins = known(&person.login);
    logins.extend(known(&person.email));
    logins
}

/// `Jane Doe` of `Doe, Jane`.
fn plain_name(name: &str) -> String {
    match name.split_once(',') {
        Some((last, first)) => format!("{} {}", first.trim(), last.trim()),
        None => name.to_owned(),
    }
}
