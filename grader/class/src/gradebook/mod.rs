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
use crate::model::{Class, Line};
use crate::table::{BadTable, Table};

pub use canvas::canvas;
pub use gradescope::gradescope;
pub use moodle::moodle;

/// A list with points in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Filled {
    /// What people call it.
    pub title: String,
    /// The list's copy.
    pub table: Table,
    /// What is not as it was.
    pub changes: Vec<Change>,
    /// What a person has to see to.
    pub warnings: Vec<String>,
}

/// A cell that changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Whose.
    pub who: String,
    /// What stood there.
    pub was: String,
    /// What stands there now.
    pub now: String,
}

/// How a list is read.
struct Shape<'a> {
    title: String,
    table: Table,
    /// The column that is filled.
    target: usize,
    /// The columns that tell people apart, the surest first.
    keys: Vec<Key<'a>>,
    /// Which rows are people.
    is_person: &'a dyn Fn(&[String]) -> bool,
    /// Which rows the platform would not change.
    is_locked: &'a dyn Fn(&[String]) -> bool,
    /// How a row is called.
    name: &'a dyn Fn(&[String]) -> String,
}

/// Two texts that mean the same person if they are the same: in a row, and of a person.
struct Key<'a> {
    of_row: Box<OfRow<'a>>,
    of_person: fn(&Person) -> Vec<String>,
}

/// What a row says under a key.
type OfRow<'a> = dyn Fn(&[String]) -> String + 'a;

/// A column, and what it is of a person.
fn key<'a>(column: usize, of_person: fn(&Person) -> Vec<String>) -> Key<'a> {
    Key {
        of_row: Box::new(move |row| row[column].clone()),
        of_person,
    }
}

/// Cells that a teacher has set on purpose.
const EXCUSED: &str = "EX";

fn fill(shape: Shape, class: &Class) -> Filled {
    let Shape {
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
    let mut filled: BTreeMap<usize, &Line> = BTreeMap::new();
    for (line, place) in places {
        let who = name(&table.rows[place]);
        if let Some(other) = filled.insert(place, line) {
            let (one, two) = (&other.row.id, &line.row.id);
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
        if !is_same(cell, counted.points) {
            changes.push(Change {
                who,
                was: cell.clone(),
                now: now.clone(),
            });
            *cell = now;
        }
    }
    Filled {
        title,
        table,
        changes,
        warnings,
    }
}

/// The row of each line's people, and who has none.
fn match_rows<'c>(
    table: &Table,
    keys: &[Key],
    is_person: &dyn Fn(&[String]) -> bool,
    name: &dyn Fn(&[String]) -> String,
    class: &'c Class,
) -> (Vec<(&'c Line, usize)>, Vec<String>) {
    // Of each key, the rows that have it: one, or nobody can be told by it.
    let indices: Vec<BTreeMap<String, Vec<usize>>> = keys
        .iter()
        .map(|key| {
            let mut index: BTreeMap<String, Vec<usize>> = BTreeMap::new();
            for (place, row) in table.rows.iter().enumerate() {
                let text = folded(&(key.of_row)(row));
                if is_person(row) && !text.is_empty() {
                    index.entry(text).or_default().push(place);
                }
            }
            index
        })
        .collect();
    let (mut places, mut warnings) = (Vec::new(), Vec::new());
    for line in &class.lines {
        for person in &line.row.about.people {
            let found = keys.iter().zip(&indices).find_map(|(key, index)| {
                let texts = (key.of_person)(person);
                let mut texts = texts.iter().map(|text| folded(text));
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
                        person.words(),
                        names.join(", ")
                    ));
                }
                None => warnings.push(format!("{} is not in this list", person.words())),
            }
        }
    }
    (places, warnings)
}

/// Without case and the space around.
fn folded(text: &str) -> String {
    text.trim().to_lowercase()
}

fn is_same(cell: &str, points: u32) -> bool {
    let number = cell.trim().replacen(',', ".", 1).parse::<f64>();
    number.is_ok_and(|number| number == f64::from(points))
}

/// What was graded for other than the list's maximum.
fn maximum_warning(class: &Class, listed: &str) -> Option<String> {
    let counted = class.lines.iter().find_map(|line| line.counted)?;
    let listed = listed.trim();
    (!listed.is_empty() && !is_same(listed, counted.max_points)).then(|| {
        format!(
            "the list is out of {listed}, and these points are out of {}: set out_of in the policy",
            counted.max_points
        )
    })
}

/// The column of this name, or what to do.
fn column(table: &Table, path: &Path, name: &str, remedy: &str) -> Result<usize, BadTable> {
    table.column(name).ok_or_else(|| BadTable::Lacks {
        path: path.to_owned(),
        lacks: name.to_owned(),
        remedy: remedy.to_owned(),
    })
}

/// Nothing in the place of nothing.
fn known(text: &str) -> Vec<String> {
    match text {
        "" => Vec::new(),
        text => vec![text.to_owned()],
    }
}

#[cfg(test)]
mod tests;
