//! Copies a gradebook exported from a platform and fills in one column of the copy.
//!
//! If a person cannot be matched with certainty, this is reported and the row stays unchanged,
//! because a wrong grade in a gradebook is only found weeks later, if ever. All other cells are
//! copied exactly as the platform wrote them, including any unusual characters in names, because
//! the platform matches its rows by them.

mod canvas;
mod gradescope;
mod moodle;

use std::collections::{BTreeMap, BTreeSet};

use crate::entry::Person;
use crate::graded_class::{ClassRow, GradedClass, PersonGrade};
use crate::names::{are_alike, are_equal, fold, fold_name, joined, number_at_end};
use crate::roster::POINTS_POSSIBLE;
use crate::table::Table;

pub use canvas::fill_canvas;
pub use gradescope::fill_gradescope;
pub use moodle::fill_moodle;

/// A copy of a gradebook with the points filled in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilledGradebook {
    /// The name used for the gradebook in messages.
    pub title: String,
    /// The copy's table with the points filled in.
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

/// A gradebook and its relevant columns.
struct Gradebook {
    title: String,
    table: Table,
    /// The column to fill in.
    target: usize,
    /// The columns that identify people, the most reliable first. If a row's cell in the first of
    /// these columns is empty, the row isn't about a person.
    keys: Vec<Key>,
    /// The columns with the parts of a person's name, for messages.
    names: Vec<usize>,
    /// The column that says `No` if the platform forbids changes to a row.
    changeable: Option<usize>,
    /// The maximum points.
    maximum: Option<String>,
}

/// A column that identifies people. A row matches a person if its value in this column is one of
/// the person's identifiers of the same kind.
struct Key {
    kind: KeyKind,
    column: usize,
    /// Returns the part of a cell's text to compare.
    text: fn(&str) -> String,
}

/// A kind of text that identifies people.
#[derive(Clone, Copy, PartialEq, Eq)]
enum KeyKind {
    /// The platform's number for a person. A file name can contain the same number by chance, so
    /// the names must be alike too.
    Number,
    /// A student id. It is unique per person, so a row with a different id is somebody else's.
    Sid,
    /// An account name, or the email address used as one. A person may have several.
    Login,
    /// An email address. A person may have several.
    Email,
    /// A name. Several people may share it.
    Name,
}

impl KeyKind {
    /// Normalises a text for comparisons.
    fn fold(self, text: &str) -> String {
        match self {
            KeyKind::Name => fold_name(text),
            KeyKind::Number | KeyKind::Sid | KeyKind::Login | KeyKind::Email => fold(text),
        }
    }
}

impl Key {
    /// Returns the key for a column. If the column contains the platform's numbers, only the number
    /// at the end of each cell is compared. Otherwise, cells are compared unchanged.
    fn new(kind: KeyKind, column: usize) -> Self {
        let text = match kind {
            KeyKind::Number => number_in,
            KeyKind::Sid | KeyKind::Login | KeyKind::Email | KeyKind::Name => str::to_owned,
        };
        Key { kind, column, text }
    }

    /// Returns the keys for all `columns` that exist in the table.
    fn of_columns(table: &Table, columns: &[(KeyKind, &str)]) -> Vec<Self> {
        let key = |(kind, name): &(KeyKind, &str)| Some(Key::new(*kind, table.column(name)?));
        columns.iter().filter_map(key).collect()
    }

    fn row_text(&self, row: &[String]) -> String {
        self.kind.fold(&(self.text)(&row[self.column]))
    }

    fn person_texts(&self, person: &Person) -> Vec<String> {
        let texts = match self.kind {
            KeyKind::Number => vec![&person.number],
            KeyKind::Sid => vec![&person.sid],
            KeyKind::Login => vec![&person.login, &person.email],
            KeyKind::Email => vec![&person.email],
            KeyKind::Name => vec![&person.name],
        };
        let known = texts.into_iter().filter(|text| !text.is_empty());
        known.map(|text| self.kind.fold(text)).collect()
    }

    /// Returns whether the key proves that a row belongs to this person.
    fn confirms(&self, row: &[String], person: &Person) -> bool {
        let known = self.row_text(row);
        let is_certain = !matches!(self.kind, KeyKind::Number | KeyKind::Name);
        is_certain && !known.is_empty() && self.person_texts(person).contains(&known)
    }

    /// Returns whether the key proves that a row doesn't belong to this person.
    fn rules_out(&self, row: &[String], person: &Person) -> bool {
        let (known, texts) = (self.row_text(row), self.person_texts(person));
        let differs = !known.is_empty() && !texts.is_empty() && !texts.contains(&known);
        matches!(self.kind, KeyKind::Sid | KeyKind::Number) && differs
    }
}

/// Returns `123` for `Participant 123`, in any language.
fn number_in(cell: &str) -> String {
    number_at_end(cell.trim()).to_owned()
}

/// The content of an excused student's cell, which is never overwritten.
const EXCUSED: &str = "EX";

impl Gradebook {
    /// Returns the name of the person in a row, for messages.
    fn name(&self, row: &[String]) -> String {
        let names = self.names.iter().map(|name| &row[*name]);
        match joined(names, " ").trim() {
            "" => row[self.keys[0].column].clone(),
            name => name.to_owned(),
        }
    }

    /// Returns the name of the person in a row. If others in the list share the name, the text in
    /// the most reliable column follows it.
    fn title(&self, row: &[String]) -> String {
        let name = self.name(row);
        let mut others = self.table.rows.iter().filter(|other| *other != row);
        if others.any(|other| self.name(other) == name) {
            format!("{name} ({})", row[self.keys[0].column].trim())
        } else {
            name
        }
    }

    fn is_person(&self, row: &[String]) -> bool {
        !row[self.keys[0].column].trim().is_empty() && self.name(row) != POINTS_POSSIBLE
    }

    fn is_locked(&self, row: &[String]) -> bool {
        let says_no = |column: usize| row[column].trim().eq_ignore_ascii_case("no");
        self.changeable.is_some_and(says_no)
    }
}

/// Fills in the points of a class.
fn fill(mut gradebook: Gradebook, class: &GradedClass) -> FilledGradebook {
    let (matches_of, mut warnings) = match_rows(&gradebook, class);
    let mut changes = Vec::new();
    for (row_index, matches) in matches_of {
        let row = &gradebook.table.rows[row_index];
        let (name, who) = (gradebook.name(row), gradebook.title(row));
        let is_locked = gradebook.is_locked(row);
        let ids = matches.iter().map(|(row, _, _)| row.result.id.as_str());
        let ids: BTreeSet<&str> = ids.collect();
        if ids.len() > 1 {
            let ids = joined(ids, ", ");
            warnings.push(format!(
                "{who} has several submissions ({ids}), so this row is left unchanged: keep only one submission"
            ));
            continue;
        }
        // A submission may list a person twice, or two people with the same email address.
        let is_named = |(_, person, _): &&GradebookMatch| are_alike(&person.name, &name);
        let best = matches.iter().find(is_named).unwrap_or(&matches[0]);
        let (class_row, first, grade) = *best;
        let others = matches.iter().filter(|(_, person, other)| {
            other.counted != grade.counted || !are_equal(&person.name, &first.name)
        });
        let others = joined(others.map(|(_, person, _)| person.display_name()), ", ");
        if !others.is_empty() {
            let id = &class_row.result.id;
            warnings.push(format!(
                "the row for {who} could also refer to {others} from {id}: enter the points by hand"
            ));
            if !is_named(&best) {
                continue;
            }
        }
        let cell = &mut gradebook.table.rows[row_index][gradebook.target];
        let why = match (&grade.counted, &grade.problem) {
            (Some(counted), _) if cell_equals(cell, counted.points) => continue,
            (None, Some(problem)) => format!(": {problem}"),
            (None, None) => format!(": {}", class_row.status(grade)),
            (Some(_), _) if is_locked => ": the platform does not allow changes".to_owned(),
            (Some(_), _) if cell.trim() == EXCUSED => " is excused".to_owned(),
            (Some(counted), _) => {
                let now = counted.points.to_string();
                let was = std::mem::replace(cell, now.clone());
                changes.push(CellChange { who, was, now });
                continue;
            }
        };
        let kept = match cell.trim() {
            "" | EXCUSED => String::new(),
            kept => format!(
                ", so the gradebook still shows {kept}: if that is wrong, change it by hand"
            ),
        };
        warnings.push(format!("{who}{why}; left unchanged{kept}"));
    }
    warnings.extend(maximum_warning(class, gradebook.maximum.as_deref()));
    FilledGradebook {
        title: gradebook.title,
        table: gradebook.table,
        changes,
        warnings,
    }
}

/// A submission, a person in the gradebook who handed it in, and that person's grade.
type GradebookMatch<'c> = (&'c ClassRow, &'c Person, &'c PersonGrade);

/// Finds each person of the class in the gradebook. Returns the matches, keyed by row index, and a
/// warning for each person who doesn't have exactly one row.
fn match_rows<'c>(
    gradebook: &Gradebook,
    class: &'c GradedClass,
) -> (BTreeMap<usize, Vec<GradebookMatch<'c>>>, Vec<String>) {
    let Gradebook { keys, table, .. } = gradebook;
    let name_in = |row_index: &usize| gradebook.title(&table.rows[*row_index]);
    // For each key, map each text to the indices of the rows that contain it. A text that occurs in
    // several rows doesn't identify anybody.
    let mut indices: Vec<BTreeMap<String, Vec<usize>>> = vec![BTreeMap::new(); keys.len()];
    for (row_index, row) in table.rows.iter().enumerate() {
        for (key, index) in keys.iter().zip(&mut indices) {
            if gradebook.is_person(row) {
                let rows = index.entry(key.row_text(row)).or_default();
                rows.push(row_index);
            }
        }
    }
    let mut matches: BTreeMap<usize, Vec<GradebookMatch>> = BTreeMap::new();
    let mut warnings = Vec::new();
    for class_row in &class.rows {
        for (person, grade) in class_row.people() {
            // The row gets the points of the attempt that counts.
            if grade.is_superseded() {
                continue;
            }
            let who = class.distinct_name(person);
            let found = keys.iter().zip(&indices).find_map(|(key, index)| {
                let texts = key.person_texts(person);
                let rows = texts.iter().find_map(|text| index.get(text))?;
                Some((key, rows.as_slice()))
            });
            let is_other = |key: &Key, row_index: usize| {
                let row = &table.rows[row_index];
                match key.kind {
                    KeyKind::Name => keys.iter().any(|key| key.rules_out(row, person)),
                    KeyKind::Number => {
                        !person.has_number(&(key.text)(&row[key.column]), &gradebook.name(row))
                            && !keys.iter().any(|key| key.confirms(row, person))
                    }
                    KeyKind::Sid | KeyKind::Login | KeyKind::Email => false,
                }
            };
            match found {
                Some((key, [row_index])) if is_other(key, *row_index) => {
                    let listed = name_in(row_index);
                    warnings.push(if key.kind == KeyKind::Number {
                        format!(
                            "{who}'s number belongs to {listed} in this list: enter the points by \
                             hand"
                        )
                    } else {
                        format!(
                            "{who} was not matched to {listed}, who has a different number or \
                             student id in this list: enter the points by hand"
                        )
                    });
                }
                Some((_, [row_index])) => {
                    let of_row = matches.entry(*row_index).or_default();
                    of_row.push((class_row, person, grade));
                }
                Some((_, several)) => {
                    let names = joined(several.iter().map(name_in), "; ");
                    warnings.push(format!(
                        "{who} could be any of {names}: enter the points by hand"
                    ));
                }
                None => warnings.push(format!(
                    "{who} is not in this list, so the copy has no row for them"
                )),
            }
        }
    }
    (matches, warnings)
}

fn cell_equals(cell: &str, points: u32) -> bool {
    let number = cell.trim().replacen(',', ".", 1).parse::<f64>();
    number.is_ok_and(|number| number == f64::from(points))
}

/// Returns a warning if the maximum of the final points differs from the gradebook's maximum.
fn maximum_warning(class: &GradedClass, listed: Option<&str>) -> Option<String> {
    let most = class.counts_max()?;
    let listed = listed?.trim();
    (!listed.is_empty() && !cell_equals(listed, most)).then(|| {
        format!(
            "the gradebook's maximum is {listed}, but these points are out of {most}: set `out_of` \
             in the policy"
        )
    })
}

#[cfg(test)]
mod tests;
