//! Grades downloaded from Gradescope: a class list with email addresses and student ids, which
//! courses import into their gradebooks.

use std::path::Path;

use super::{FilledGradebook, Gradebook, Key, KeyKind, fill};
use crate::error::Error;
use crate::graded_class::GradedClass;
use crate::table::Table;

const REMEDY: &str =
    "download the grades from the assignment's page (Review Grades, Download Grades)";

/// Reads the grades at `path` and fills in the class's points as the total score.
pub fn fill_gradescope(path: &Path, class: &GradedClass) -> Result<FilledGradebook, Error> {
    let table = Table::read(path)?;
    let target = table.require_column(path, "Total Score", REMEDY)?;
    table.require_column(path, "Email", REMEDY)?;
    let keys = [(KeyKind::Email, "Email"), (KeyKind::Sid, "SID")];
    let names = ["First Name", "Last Name", "Name"];
    let gradebook = Gradebook {
        title: "Gradescope".to_owned(),
        target,
        keys: Key::of_columns(&table, &keys),
        names: names.iter().filter_map(|name| table.column(name)).collect(),
        changeable: None,
        maximum: table.first_cell("Max Points"),
        table,
    };
    Ok(fill(gradebook, class))
}
