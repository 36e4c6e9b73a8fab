//! Fills in one column of a copy of a gradebook that was exported from a platform.
//!
//! A person who cannot be matched for certain is reported, and the row is left unchanged: a wrong
//! grade in a gradebook is found weeks later, if ever. All other cells are copied as the platform
//! wrote them, whatever characters a name has, since the platform matches its rows by them.

mod canvas;
mod gradescope;
mod moodle;

use std::collections::{BTreeMap, BTreeSet};

use crate::entry::Person;
use crate::graded_class::{ClassRow, GradeProblem, GradedClass, PersonGrade};
use crate::names::{are_alike, are_equal, fold};
use crate::table::Table;

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
    /// The platform's own number, which a file name can have by chance: the names must be alike too.
    Number,
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
    /// Returns whether the key says for certain that a row is of this person.
    fn confirms(&self, row: &[String], person: &Person) -> bool {
        let known = fold(&(self.row_text)(row));
        let texts = (self.person_texts)(person);
        let is_certain = matches!(self.kind, KeyKind::Only | KeyKind::OneOfSeveral);
        is_certain && !known.is_empty() && texts.iter().any(|text| fold(text) == known)
    }

    /// Returns whether the key says that a row is not of this person.
    fn rules_out(&self, row: &[String], person: &Person) -> bool {
        let known = fold(&(self.row_text)(row));
        let texts = (self.person_texts)(person);
        let is_other = |text: &String| fold(text) != known;
        let differs = !known.is_empty() && !texts.is_empty() && texts.iter().all(is_other);
        matches!(self.kind, KeyKind::Only | KeyKind::Number) && differs
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
    let mut matches_of: BTreeMap<usize, Vec<GradebookMatch>> = BTreeMap::new();
    for (row_index, matched) in matches {
        matches_of.entry(row_index).or_default().push(matched);
    }
    for (row_index, matches) in matches_of {
        let who = name(&table.rows[row_index]);
        let ids = matches.iter().map(|(row, _, _)| row.result.id.as_str());
        let ids: BTreeSet<&str> = ids.collect();
        if ids.len() > 1 {
            let ids = Vec::from_iter(ids).join(", ");
            warnings.push(format!(
                "{who} has several submissions ({ids}): keep one; left unchanged"
            ));
            continue;
        }
        // A submission may list a person twice, or two people with one email address.
        let is_named = |(_, person, _): &&GradebookMatch| are_alike(&person.name, &who);
        let best = matches.iter().find(is_named).unwrap_or(&matches[0]);
        let (class_row, first, grade) = *best;
        let others = matches.iter().filter(|(_, person, other)| {
            other.counted != grade.counted || !are_equal(&person.name, &first.name)
        });
        let others: Vec<&str> = others.map(|(_, person, _)| person.display_name()).collect();
        if !others.is_empty() {
            let id = &class_row.result.id;
            warnings.push(format!(
                "{} of {id} could be {who} as well: fill in by hand",
                others.join(", ")
            ));
            if !is_named(&best) {
                continue;
            }
        }
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

/// A submission, a person of it who is in the gradebook, and the person's grade.
type GradebookMatch<'c> = (&'c ClassRow, &'c Person, &'c PersonGrade);

/// Finds each person of the class in the gradebook, by the index of the row. Also returns a warning
/// for each person without exactly one row.
fn match_rows<'c>(
    table: &Table,
    keys: &[MatchKey],
    is_person: &dyn Fn(&[String]) -> bool,
    name: &dyn Fn(&[String]) -> String,
    class: &'c GradedClass,
) -> (Vec<(usize, GradebookMatch<'c>)>, Vec<String>) {
    // For each key, the indices of the rows with each text. A text that is in several rows
    // identifies nobody.
    let indices: Vec<BTreeMap<String, Vec<usize>>> = keys
        .iter()
        .map(|key| {
            let mut index: BTreeMap<String, Vec<usize>> = BTreeMap::new();
            for (row_index, row) in table.rows.iter().enumerate() {
                let text = fold(&(key.row_text)(row));
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
                let mut texts = texts.iter().map(|text| fold(text));
                texts.find_map(|text| Some((key, index.get(&text)?.as_slice())))
            });
            let is_other = |key: &MatchKey, row_index: usize| {
                let row = &table.rows[row_index];
                match key.kind {
                    KeyKind::Name => keys.iter().any(|key| key.rules_out(row, person)),
                    KeyKind::Number => {
                        !person.has_number(&(key.row_text)(row), &name(row))
                            && !keys.iter().any(|key| key.confirms(row, person))
                    }
                    KeyKind::Only | KeyKind::OneOfSeveral => false,
                }
            };
            match found {
                Some((key, [row_index])) if is_other(key, *row_index) => {
                    let (person, listed) = (person.display_name(), name(&table.rows[*row_index]));
                    warnings.push(match key.kind {
                        KeyKind::Number => format!(
                            "{person} is not {listed}, who has the same number in this list: fill in \
                             by hand"
                        ),
                        KeyKind::Only | KeyKind::OneOfSeveral | KeyKind::Name => format!(
                            "{person} is not in this list: {listed} has another number or student id; \
                             fill in by hand"
                        ),
                    });
                }
                Some((_, [row_index])) => {
                    matches.push((*row_index, (class_row, person, grade)));
                }
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

/// Returns a list that contains only the text, or an empty list if the text is empty.
fn non_empty(text: &str) -> Vec<String> {
    match text {
        "" => Vec::new(),
        text => vec![text.to_owned()],
    }
}

#[cfg(test)]
mod tests;
