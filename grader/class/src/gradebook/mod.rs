//! Fills in one column of a copy of a gradebook that was exported from a platform.
//!
//! A person who cannot be matched for certain is reported, and the row is left unchanged: a wrong
//! grade in a gradebook is found weeks later, if ever. All other cells are copied as the platform
//! wrote them, whatever characters a name has, since the platform matches its rows by them.

mod canvas;
mod gradescope;
mod moodle;

use std::collections::BTreeMap;
use std::path::Path;

use crate::entry::Person;
use crate::model::{ClassRow, GradeProblem, GradedClass, PersonGrade};
use crate::table::{Table, TableError};

pub use canvas::fill_canvas;
pub use gradescope::fill_gradescope;
pub use moodle::fill_moodle;

/// A copy of a gradebook with the points filled in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilledGradebook {
    /// The gradebook's name for messages.
    pub title: String,
    /// The copy's table, with the points filled in.
    pub table: Table,
    /// The cells that changed.
    pub changes: Vec<CellChange>,
    /// Problems that the teacher has to resolve.
    pub warnings: Vec<String>,
}

/// A cell of the gradebook that changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellChange {
    /// The student's name.
    pub who: String,
    /// The content of the cell before the change.
    pub was: String,
    /// The content of the cell after the change.
    pub now: String,
}

/// A gradebook, with the rules for reading and filling it in.
struct GradebookSpec<'a> {
    title: String,
    table: Table,
    /// The index of the column to fill in.
    target: usize,
    /// The keys that identify people, the most reliable first.
    keys: Vec<MatchKey<'a>>,
    /// Returns whether a row belongs to a person.
    is_person: &'a dyn Fn(&[String]) -> bool,
    /// Returns whether the platform forbids changes to a row.
    is_locked: &'a dyn Fn(&[String]) -> bool,
    /// Returns the name of the person in a row, for messages.
    name: &'a dyn Fn(&[String]) -> String,
}

/// A key for matching rows with people: a row matches if its text equals one of the person's texts.
struct MatchKey<'a> {
    kind: KeyKind,
    row_text: Box<RowText<'a>>,
    person_texts: fn(&Person) -> Vec<String>,
}

/// A key's relation to people.
#[derive(Clone, Copy, PartialEq, Eq)]
enum KeyKind {
    /// A person has only one, such as a student id: a row with another one is somebody else's.
    Only,
    /// A person may have several, such as email addresses.
    OneOfSeveral,
    /// Two people may have the same one.
    Name,
}

/// A function that returns a row's text for a key.
type RowText<'a> = dyn Fn(&[String]) -> String + 'a;

impl MatchKey<'_> {
    /// Returns whether the key says that a row is not of this person.
    fn rules_out(&self, row: &[String], person: &Person) -> bool {
        let known = normalise(&(self.row_text)(row));
        let texts = (self.person_texts)(person);
        let is_other = |text: &String| normalise(text) != known;
        let differs = !known.is_empty() && !texts.is_empty() && texts.iter().all(is_other);
        self.kind == KeyKind::Only && differs
    }
}

/// Returns a key that takes the text of a row from a column.
fn column_key<'a>(
    kind: KeyKind,
    column: usize,
    person_texts: fn(&Person) -> Vec<String>,
) -> MatchKey<'a> {
    MatchKey {
        kind,
        row_text: Box::new(move |row| row[column].clone()),
        person_texts,
    }
}

/// The content of an excused student's cell, which is never overwritten.
const EXCUSED: &str = "EX";

fn fill(spec: GradebookSpec, class: &GradedClass) -> FilledGradebook {
    let GradebookSpec {
        title,
        mut table,
        target,
        keys,
        is_person,
        is_locked,
        name,
    } = spec;
    let (matches, mut warnings) = match_rows(&table, &keys, is_person, name, class);
    let mut changes = Vec::new();
    let mut submissions_of: BTreeMap<usize, Vec<(&ClassRow, &PersonGrade)>> = BTreeMap::new();
    for (class_row, grade, row_index) in matches {
        let submissions = submissions_of.entry(row_index).or_default();
        submissions.push((class_row, grade));
    }
    for (row_index, submissions) in submissions_of {
        let who = name(&table.rows[row_index]);
        let [(class_row, grade)] = submissions[..] else {
            let ids = submissions.iter().map(|(row, _)| row.result.id.as_str());
            let ids = ids.collect::<Vec<_>>().join(", ");
            warnings.push(format!(
                "{who} has several submissions ({ids}): keep one; left unchanged"
            ));
            continue;
        };
        let locked = is_locked(&table.rows[row_index]);
        let cell = &mut table.rows[row_index][target];
        let Some(counted) = grade.counted else {
            let why = match &grade.problem {
                Some(problem) => problem.to_string(),
                None => class_row.status(grade).to_owned(),
            };
            warnings.push(format!("{who}: {why}; left unchanged"));
            continue;
        };
        if locked {
            warnings.push(format!(
                "{who}: the platform does not allow changes; left unchanged"
            ));
            continue;
        }
        if cell.trim() == EXCUSED {
            warnings.push(format!("{who} is excused; left unchanged"));
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

/// A person's submission and grade, and the index of their row in the gradebook.
type GradebookMatch<'c> = (&'c ClassRow, &'c PersonGrade, usize);

/// Finds the row of each person in the class. Also returns a warning for each person without
/// exactly one row.
fn match_rows<'c>(
    table: &Table,
    keys: &[MatchKey],
    is_person: &dyn Fn(&[String]) -> bool,
    name: &dyn Fn(&[String]) -> String,
    class: &'c GradedClass,
) -> (Vec<GradebookMatch<'c>>, Vec<String>) {
    // For each key, the indices of the rows with each text. A text that is in several rows
    // identifies nobody.
    let indices: Vec<BTreeMap<String, Vec<usize>>> = keys
        .iter()
        .map(|key| {
            let mut index: BTreeMap<String, Vec<usize>> = BTreeMap::new();
            for (row_index, row) in table.rows.iter().enumerate() {
                let text = normalise(&(key.row_text)(row));
                if is_person(row) && !text.is_empty() {
                    index.entry(text).or_default().push(row_index);
                }
            }
            index
        })
        .collect();
    let (mut matches, mut warnings) = (Vec::new(), Vec::new());
    for class_row in &class.rows {
        for (person, grade) in class_row.people() {
            // The row gets the points of the attempt that counts.
            if matches!(grade.problem, Some(GradeProblem::OtherAttempt(_))) {
                continue;
            }
            let found = keys.iter().zip(&indices).find_map(|(key, index)| {
                let texts = (key.person_texts)(person);
                let mut texts = texts.iter().map(|text| normalise(text));
                texts.find_map(|text| Some((key.kind, index.get(&text)?.as_slice())))
            });
            let is_namesake = |row_index: usize| {
                let row = &table.rows[row_index];
                keys.iter().any(|key| key.rules_out(row, person))
            };
            match found {
                Some((KeyKind::Name, [row_index])) if is_namesake(*row_index) => {
                    warnings.push(format!(
                        "{} is not in this list: {} has another number or student id; fill in by hand",
                        person.display_name(),
                        name(&table.rows[*row_index])
                    ));
                }
                Some((_, [row_index])) => matches.push((class_row, grade, *row_index)),
                Some((_, several)) => {
                    let names: Vec<String> = several
                        .iter()
                        .map(|row_index| name(&table.rows[*row_index]))
                        .collect();
                    warnings.push(format!(
                        "{} could be any of {}: fill in by hand",
                        person.display_name(),
                        names.join("; ")
                    ));
                }
                None => warnings.push(format!("{} is not in this list", person.display_name())),
            }
        }
    }
    (matches, warnings)
}

/// Returns the text in lower case, without white space at its ends.
fn normalise(text: &str) -> String {
    text.trim().to_lowercase()
}

fn cell_equals(cell: &str, points: u32) -> bool {
    let number = cell.trim().replacen(',', ".", 1).parse::<f64>();
    number.is_ok_and(|number| number == f64::from(points))
}

/// Returns a warning if the maximum of the counted points differs from the maximum in the
/// gradebook.
fn maximum_warning(class: &GradedClass, listed: &str) -> Option<String> {
    let mut grades = class.rows.iter().flat_map(|class_row| &class_row.grades);
    let counted = grades.find_map(|grade| grade.counted)?;
    let listed = listed.trim();
    (!listed.is_empty() && !cell_equals(listed, counted.max_points)).then(|| {
        format!(
            "the gradebook's maximum is {listed}, but these points are out of {}: set out_of in \
             the policy",
            counted.max_points
        )
    })
}

/// Returns the index of the column with this name. If there is no such column, the error says what
/// to do.
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

/// Returns a list that contains only the text, or an empty list if the text is empty.
fn non_empty(text: &str) -> Vec<String> {
    match text {
        "" => Vec::new(),
        text => vec![text.to_owned()],
    }
}

#[cfg(test)]
mod tests;
