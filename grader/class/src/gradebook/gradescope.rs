//! Grades downloaded from Gradescope: a list of the class with email addresses and student ids,
//! which courses import into their own gradebook.

use std::path::Path;

use super::{
    FilledGradebook, GradebookSpec, KeyKind, column_key, fill, maximum_warning, non_empty,
};
use crate::error::Error;
use crate::graded_class::GradedClass;
use crate::table::Table;

const REMEDY: &str =
    "download the grades from the assignment's page (Review Grades, Download Grades)";

/// Reads the grades at `path` and fills in the class's points as the total score.
pub fn fill_gradescope(path: &Path, class: &GradedClass) -> Result<FilledGradebook, Error> {
    let table = Table::read(path)?;
    let target = table.require_column(path, "Total Score", REMEDY)?;
    let email = table.require_column(path, "Email", REMEDY)?;
    let names: Vec<usize> = ["First Name", "Last Name", "Name"]
        .iter()
        .filter_map(|name| table.column(name))
        .collect();
    let maximum = table.column("Max Points");
    let maximum = maximum.and_then(|column| table.rows.first()?.get(column).cloned());
    let warning = maximum.and_then(|maximum| maximum_warning(class, &maximum));
    let mut keys = vec![column_key(KeyKind::OneOfSeveral, email, |person| {
        non_empty(&person.email)
    })];
    let sid = table.column("SID");
    keys.extend(
        sid.map(|column| column_key(KeyKind::Only, column, |person| non_empty(&person.sid))),
    );
    let mut filled = fill(
        GradebookSpec {
            title: "Gradescope".to_owned(),
            table,
            target,
            keys,
            is_person: &|row| !row[email].trim().is_empty(),
            is_locked: &|_| false,
            name: &|row| {
                let names: Vec<&str> = names.iter().map(|name| row[*name].as_str()).collect();
                match names.join(" ").trim() {
                    "" => row[email].clone(),
                    name => name.to_owned(),
                }
            },
        },
        class,
    );
    filled.warnings.extend(warning);
    Ok(filled)
}
