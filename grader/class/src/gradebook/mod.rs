//! Filling one column of a list that a platform has given out. Pure.
//!
//! Whoever can not be matched for certain is told and left as it stands: a wrong grade in a
//! gradebook is found weeks later, if ever.

mod canvas;
mod gradescope;
mod moodle;

use std::collections::BTreeMap;
use std::path::Path;

use crate::entry::Person;
use crate::model::{ClassRow, GradedClass};
use crate::table::{Table, TableError};

pub use canvas::fill_canvas;
pub use gradescope::fill_gradescope;
pub use moodle::fill_moodle;

/// A list with points in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilledGradebook {
    /// What people call it.
    pub title: String,
    /// The list's copy.
    pub table: Table,
    /// What is not as it was.
    pub changes: Vec<CellChange>,
    /// What a person has to see to.
    pub warnings: Vec<String>,
}

/// A cell that changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellChange {
    /// Whose.
    pub who: String,
    /// What stood there.
    pub was: String,
    /// What stands there now.
    pub now: String,
}

/// How a list is read.
struct GradebookSpec<'a> {
    title: String,
    table: Table,
    /// The column that is filled.
    target: usize,
    /// The columns that tell people apart, the surest first.
    keys: Vec<MatchKey<'a>>,
    /// Which rows are people.
    is_person: &'a dyn Fn(&[String]) -> bool,
    /// Which rows the platform would not change.
    is_locked: &'a dyn Fn(&[String]) -> bool,
    /// How a row is called.
    name: &'a dyn Fn(&[String]) -> String,
}

/// Two texts that mean the same person if they are the same: in a row, and of a person.
struct MatchKey<'a> {
    row_text: Box<RowText<'a>>,
    person_texts: fn(&Person) -> Vec<String>,
}

/// What a row says under a key.
type RowText<'a> = dyn Fn(&[String]) -> String + 'a;

/// A column, and what it is of a person.
fn column_key<'a>(column: usize, of_person: fn(&Person) -> Vec<String>) -> MatchKey<'a> {
    MatchKey {
        row_text: Box::new(move |row| row[column].clone()),
        person_texts: of_person,
    }
}

/// Cells that a teacher has set on purpose.
const EXCUSED: &str = "EX";

fn fill(shape: GradebookSpec, class: &GradedClass) -> FilledGradebook {
    let GradebookSpec {
        title,
        mut table,
        target,
        keys,
        is_person,
        is_locked,
        name,
    } = shape;
    let (places, mut warnings) = match_rows(&table, &keys, is_person, name, class);
    let mut changes = Vec::new();
    let mut filled: BTreeMap<usize, &ClassRow> = BTreeMap::new();
    for (line, place) in places {
        let who = name(&table.rows[place]);
        if let Some(other) = filled.insert(place, line) {
            let (one, two) = (&other.result.id, &line.result.id);
            warnings.push(format!(
                "{who} has two submissions, {one} and {two}: keep one"
            ));
        }
    }
    // Of two, neither counts.
    let twice = |warnings: &[String], who: &str| {
        let begin = format!("{who} has two submissions");
        warnings.iter().any(|warning| warning.starts_with(&begin))
    };
    for (place, line) in filled {
        let who = name(&table.rows[place]);
        let locked = is_locked(&table.rows[place]);
        let cell = &mut table.rows[place][target];
        let Some(counted) = line.counted else {
            warnings.push(format!("{who}: {}, left as it is", line.status()));
            continue;
        };
        if twice(&warnings, &who) {
            continue;
        }
        if locked {
            warnings.push(format!("{who} can not be changed there, left as it is"));
            continue;
        }
        if cell.trim() == EXCUSED {
            warnings.push(format!("{who} is excused, left as it is"));
            continue;
        }
        let now = counted.points.to_string();
        if !cell_equals(cell, counted.points) {
            changes.push(CellChange {
                who,
                was: cell.clone(),
                now: now.clone(),
            });
            *cell = now;
        }
    }
    FilledGradebook {
        title,
        table,
        changes,
        warnings,
    }
}

/// The row of each line's people, and who has none.
fn match_rows<'c>(
    table: &Table,
    keys: &[MatchKey],
    is_person: &dyn Fn(&[String]) -> bool,
    name: &dyn Fn(&[String]) -> String,
    class: &'c GradedClass,
) -> (Vec<(&'c ClassRow, usize)>, Vec<String>) {
    // Of each key, the rows that have it: one, or nobody can be told by it.
    let indices: Vec<BTreeMap<String, Vec<usize>>> = keys
        .iter()
        .map(|key| {
            let mut index: BTreeMap<String, Vec<usize>> = BTreeMap::new();
            for (place, row) in table.rows.iter().enumerate() {
                let text = normalise(&(key.row_text)(row));
                if is_person(row) && !text.is_empty() {
                    index.entry(text).or_default().push(place);
                }
            }
            index
        })
        .collect();
    let (mut places, mut warnings) = (Vec::new(), Vec::new());
    for line in &class.rows {
        for person in &line.result.info.people {
            let found = keys.iter().zip(&indices).find_map(|(key, index)| {
                let texts = (key.person_texts)(person);
                let mut texts = texts.iter().map(|text| normalise(text));
                texts.find_map(|text| index.get(&text))
            });
            match found.map(Vec::as_slice) {
                Some([place]) => places.push((line, *place)),
                Some(several) => {
                    let names: Vec<String> = several
                        .iter()
                        .map(|place| name(&table.rows[*place]))
                        .collect();
                    warnings.push(format!(
                        "{} could be any of {}: fill in by hand",
                        person.display_name(),
                        names.join(", ")
                    ));
                }
                None => warnings.push(format!("{} is not in this list", person.display_name())),
            }
        }
    }
    (places, warnings)
}

/// Without case and the space around.
fn normalise(text: &str) -> String {
    text.trim().to_lowercase()
}

fn cell_equals(cell: &str, points: u32) -> bool {
    let number = cell.trim().replacen(',', ".", 1).parse::<f64>();
    number.is_ok_and(|number| number == f64::from(points))
}

/// What was graded for other than the list's maximum.
fn maximum_warning(class: &GradedClass, listed: &str) -> Option<String> {
    let counted = class.rows.iter().find_map(|line| line.counted)?;
    let listed = listed.trim();
    (!listed.is_empty() && !cell_equals(listed, counted.max_points)).then(|| {
        format!(
            "the list is out of {listed}, and these points are out of {}: set out_of in the policy",
            counted.max_points
        )
    })
}

/// The column of this name, or what to do.
fn require_column(
    table: &Table,
    path: &Path,
    name: &str,
    remedy: &str,
) -> Result<usize, TableError> {
    table.column(name).ok_or_else(|| TableError::MissingColumn {
        path: path.to_owned(),
        column: name.to_owned(),
        remedy: remedy.to_owned(),
    })
}

/// Nothing in the place of nothing.
fn non_empty(text: &str) -> Vec<String> {
    match text {
        "" => Vec::new(),
        text => vec![text.to_owned()],
    }
}

#[cfg(test)]
mod tests;
