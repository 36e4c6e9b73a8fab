//! Canvas's gradebook. Canvas's importer accepts any content, creates an assignment for each
//! unknown title, and silently ignores some columns. So the teacher's own export serves as the
//! template, and only the assignment's column and the columns that identify people are written
//! back.

use std::path::Path;

use super::{FilledGradebook, Gradebook, Key, KeyKind, fill};
use crate::error::Error;
use crate::graded_class::GradedClass;
use crate::names::{given_name_first, is_number, joined};
use crate::roster::POINTS_POSSIBLE;
use crate::table::{Table, missing_column};

const REMEDY: &str = "export the gradebook from Canvas (Grades, Export) and pass that file";
/// The title of the last of the columns that identify people.
const SECTION: &str = "Section";
/// Canvas silently ignores any column whose title contains one of these texts.
const IGNORED_TITLES: &str = "Current Score,Current Points,Current Grade,Final Score,Final Points,\
                              Final Grade,Override Score,Override Grade,Override Status";

/// Reads the gradebook at `path` and fills in the class's points. `column` is the title or number
/// of the assignment's column.
pub fn fill_canvas(
    path: &Path,
    column: Option<&str>,
    class: &GradedClass,
) -> Result<FilledGradebook, Error> {
    let table = Table::read(path)?;
    let student = table.require_column(path, "Student", REMEDY)?;
    table.require_column(path, "ID", REMEDY)?;
    let section = table.require_column(path, SECTION, REMEDY)?;
    let target = find_target(&table, section, path, column)?;
    let title = table.header[target].clone();
    let columns: Vec<usize> = (0..=section).chain([target]).collect();
    let table = table.select_columns(&columns);
    let target = columns.len() - 1;

    let mut rows = table.rows.iter();
    let possible = rows.find(|row| row[student].trim() == POINTS_POSSIBLE);
    let keys = [
        (KeyKind::Number, "ID"),
        (KeyKind::Sid, "SIS User ID"),
        (KeyKind::Login, "SIS Login ID"),
    ];
    let mut keys = Key::of_columns(&table, &keys);
    keys.push(Key {
        text: given_name_first,
        ..Key::new(KeyKind::Name, student)
    });
    let gradebook = Gradebook {
        title: format!("Canvas, {title}"),
        target,
        keys,
        names: vec![student],
        changeable: None,
        maximum: possible.map(|row| row[target].clone()),
        table,
    };
    Ok(fill(gradebook, class))
}

/// Returns the index of the column with this title or number. If `column` is `None`, returns the
/// index of the only assignment's column.
fn find_target(
    table: &Table,
    section: usize,
    path: &Path,
    column: Option<&str>,
) -> Result<usize, Error> {
    let names = table.header.iter().enumerate().skip(section + 1);
    let names: Vec<(usize, &str)> = names.map(|(index, name)| (index, name.trim())).collect();
    let is_ignored = |name: &str| IGNORED_TITLES.split(',').any(|title| name.contains(title));
    let is_wanted = |title: &str| {
        let (name, number) = split_title(title);
        match column {
            Some(column) => [title, name].contains(&column) || number == Some(column),
            None => number.is_some(),
        }
    };
    let found = names.iter().filter(|(_, name)| is_wanted(name)).copied();
    let found: Vec<(usize, &str)> = found.collect();
    let titles = |names: &[(usize, &str)]| joined(names.iter().map(|(_, name)| *name), "; ");
    let title = column.unwrap_or("that clearly belongs to the assignment");
    let missing = |remedy: &str| Err(missing_column(path, title, remedy));
    match found.as_slice() {
        [(_, name)] if is_ignored(name) => missing(&format!(
            "Canvas ignores columns with a title like {name:?}, so rename the assignment"
        )),
        [(index, _)] => Ok(*index),
        [] => missing(&format!(
            "choose one of these with --column, by its title or by the number at the end of its \
             title: {}",
            titles(&names)
        )),
        several => missing(&format!("choose one with --column: {}", titles(several))),
    }
}

/// Splits `Path Tracer (123456)` into the name and the number. Other titles don't contain a number.
fn split_title(title: &str) -> (&str, Option<&str>) {
    let parts = title.strip_suffix(')');
    let parts = parts.and_then(|rest| rest.rsplit_once('('));
    match parts.filter(|(_, number)| is_number(number)) {
        Some((name, number)) => (name.trim_end(), Some(number)),
        None => (title, None),
    }
}
