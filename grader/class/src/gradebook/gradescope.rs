//! Gradescope's downloaded grades: a list of the class with the address and number of each, which
//! courses load into whatever they keep grades in.

use std::path::Path;

use super::{Filled, Shape, column, fill, key, known, maximum_warning};
use crate::model::Class;
use crate::table::{BadTable, Table};

const REMEDY: &str =
    "download the grades from the assignment's page (Review Grades, Download Grades)";

/// The grades at `path`, with the class's points in the place of the total.
pub fn gradescope(path: &Path, class: &Class) -> Result<Filled, BadTable> {
    let table = Table::read(path)?;
    let target = column(&table, path, "Total Score", REMEDY)?;
    let email = column(&table, path, "Email", REMEDY)?;
    let names: Vec<usize> = ["First Name", "Last Name", "Name"]
        .iter()
        .filter_map(|name| table.column(name))
        .collect();
    let maximum = table.column("Max Points");
    let maximum = maximum.and_then(|column| table.rows.first()?.get(column).cloned());
    let warning = maximum.and_then(|maximum| maximum_warning(class, &maximum));
    let mut keys = vec![key(email, |person| known(&person.email))];
    let sid = table.column("SID");
    keys.extend(sid.map(|column| key(column, |person| known(&person.sid))));
    let mut filled = fill(
        Shape {
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
