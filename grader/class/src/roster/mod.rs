//! Reads the people of a class from a roster or gradebook. Columns are recognised by their names.

mod times;

use std::collections::BTreeMap;
use std::path::Path;

use crate::cli::Lists;
use crate::entry::Person;
use crate::error::Error;
use crate::list_kind::ListKind;
use crate::moodle_status::MoodleStatus;
use crate::names::{are_equal, fold, number_at_end};
use crate::table::{Table, missing_column};

pub use times::set_submission_times;

/// Column names that platforms and people use for a person's full name. The lists below are for the
/// other fields.
const NAME: [&str; 4] = ["name", "full name", "student", "student name"];
const FIRST: [&str; 3] = ["first name", "first_name", "given name"];
const LAST: [&str; 4] = ["last name", "last_name", "surname", "family name"];
const EMAIL: [&str; 3] = ["email", "email address", "e-mail"];
const SID: [&str; 7] = [
    "sid",
    "student id",
    "id number",
    "sis user id",
    "roster_identifier",
    "matriculation number",
    "user_id",
];
const LOGIN: [&str; 7] = [
    "username",
    "login",
    "github",
    "github_username",
    "github username",
    "sis login id",
    "login_id",
];
/// Column names for submission times in classroom50 and GitHub Classroom.
const SUBMISSION_TIME: [&str; 4] = [
    "datetime",
    "submission_timestamp",
    // The lists exported by Gradescope and Moodle.
    "submission time",
    "last modified (submission)",
];
const GROUP: [&str; 4] = ["group", "group name", "group_name", "team"];
const SECTION: [&str; 4] = ["section", "tutor", "tutorial", "lab"];
const EXTENSION: [&str; 3] = ["extension", "extension_days", "extension days"];

/// The name in the row of Canvas's gradebook with the maximum points.
pub const POINTS_POSSIBLE: &str = "Points Possible";

/// A row of a roster or gradebook.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// The list that contains the row.
    pub list: ListKind,
    /// The row number, as in spreadsheets.
    row: usize,
    /// The person the row is about.
    pub person: Person,
    /// The submission time, in the list's format. Empty if the list doesn't contain one.
    pub submitted: String,
    /// Whether the list marks the submission as late.
    pub late: bool,
    /// Whether another person in the list shares the name. If so, the name identifies neither of
    /// them.
    has_namesake: bool,
}

impl Member {
    /// Returns whether this row is about the person.
    pub fn matches(&self, person: &Person) -> bool {
        person.matches(&self.person) || self.matches_by_name(person)
    }

    /// Returns whether the person's name equals the name or an identifier in this row. Names are
    /// only compared if the person's email address, student id and account name are unknown, as in
    /// a folder named after a student, and if the row or the person lacks a platform number.
    fn matches_by_name(&self, person: &Person) -> bool {
        let known = &self.person;
        let is_bare = person.own_identifiers() == [""; 3];
        let is_numbered = !person.number.is_empty() && !known.number.is_empty();
        let name = (!self.has_namesake).then_some(known.name.as_str());
        let mut names = known.own_identifiers().into_iter().chain(name);
        let same = |known: &str| !known.is_empty() && are_equal(known, &person.name);
        is_bare && !is_numbered && names.any(same)
    }

    fn is_namesake_of(&self, other: &Member) -> bool {
        let (one, other) = (&self.person, &other.person);
        are_equal(&one.name, &other.name) && !one.matches(other) && one != other
    }
}

/// Reads the people in a roster or in a platform's gradebook.
fn read_members(path: &Path, list: ListKind) -> Result<Vec<Member>, Error> {
    let remedy = "it needs at least one of the columns name, email, sid and username; in another \
        language, column heads are not recognised";
    let members = parse_members(&Table::read(path)?, list);
    members.ok_or_else(|| missing_column(path, "that identifies people", remedy))
}

fn parse_members(table: &Table, list: ListKind) -> Option<Vec<Member>> {
    let column = |names: &[&str]| names.iter().find_map(|name| table.column(name));
    let columns = [
        &NAME[..],
        &FIRST,
        &LAST,
        &EMAIL,
        &SID,
        &LOGIN,
        &GROUP,
        &SECTION,
        &EXTENSION,
    ];
    let columns = columns.map(column);
    let [name, _, _, email, sid, login, ..] = columns;
    let [submitted, late] = [column(&SUBMISSION_TIME), table.column("late")];
    // Moodle writes a word in the site's language before the number.
    let identifier = table.column("Identifier");
    // A list needs one of these columns to match its rows with submissions.
    email.or(sid).or(login).or(name).or(identifier)?;
    // Use the platform's own numbers if the list is recognised as Canvas's or Moodle's.
    let number = match table.column("Student") {
        Some(_) => table.column("ID"),
        None => identifier.or_else(|| table.column("canvas_user_id")),
    };
    // In other lists, a status column means something else.
    let status = table.column("Identifier").and(table.column("Status"));
    let member = |(row_number, row): (usize, &Vec<String>)| {
        let cell = |column: Option<usize>| {
            let cell = column.and_then(|column| row.get(column));
            cell.map(|cell| cell.trim().to_owned()).unwrap_or_default()
        };
        let [
            name,
            first,
            last,
            email,
            sid,
            login,
            group,
            section,
            extension,
        ] = columns.map(cell);
        let parts = format!("{first} {last}").trim().to_owned();
        // With blind marking, the list contains no names.
        let names = [name, parts, cell(identifier)];
        let name = names.into_iter().find(|name| !name.is_empty());
        let person = Person {
            name: name.unwrap_or_default(),
            email,
            sid,
            login,
            number: number_at_end(&cell(number)).to_owned(),
            group,
            section,
            extension,
            status: cell(status),
            is_named_by_file: false,
            is_from_group: false,
            is_listed: true,
        };
        Member {
            list,
            row: row_number,
            person,
            // Moodle writes a dash for participants who submitted nothing.
            submitted: Some(cell(submitted))
                .filter(|time| time != "-")
                .unwrap_or_default(),
            late: cell(late).eq_ignore_ascii_case("true")
                || MoodleStatus::parse(&cell(status)).is_late,
            has_namesake: false,
        }
    };
    let members = table.numbered_rows().map(member);
    let is_person = |Member { person, .. }: &Member| {
        !person.display_name().is_empty()
            && person.name != POINTS_POSSIBLE
            && !person.is_test_student()
    };
    let mut members: Vec<Member> = members.filter(is_person).collect();
    let namesakes: Vec<bool> = members
        .iter()
        .map(|one| members.iter().any(|other| one.is_namesake_of(other)))
        .collect();
    for (member, has_namesake) in members.iter_mut().zip(namesakes) {
        member.has_namesake = has_namesake;
    }
    Some(members)
}

/// Rejects a roster where two rows share an email address, student id or account name but differ
/// otherwise. A row may be repeated, e.g. for each attempt or section.
fn check_keys(path: &Path, members: &[Member]) -> Result<(), Error> {
    let mut rows: BTreeMap<(usize, String), usize> = BTreeMap::new();
    for (index, member) in members.iter().enumerate() {
        for (kind, key) in member.person.own_identifiers().into_iter().enumerate() {
            if key.is_empty() {
                continue;
            }
            let first = *rows.entry((kind, fold(key))).or_insert(index);
            if !is_repetition(&members[first].person, &member.person) {
                return Err(Error::user(format!(
                    "{}: rows {} and {} both have {key:?}, but differ otherwise: correct one of them",
                    path.display(),
                    members[first].row,
                    member.row
                )));
            }
        }
    }
    Ok(())
}

/// Returns whether two rows contain the same information about a person.
fn is_repetition(one: &Person, other: &Person) -> bool {
    let [own, others] = [one, other].map(|person| {
        let others = [&person.name, &person.group, &person.extension];
        let others = others.into_iter().map(String::as_str);
        person.own_identifiers().into_iter().chain(others)
    });
    let mut pairs = own.zip(others);
    pairs.all(|(one, other)| are_equal(one, other))
}

/// Reads the people on all lists. A person has one row per list they are on. No two people in the
/// roster may share an identifier.
pub fn read_lists(lists: &Lists) -> Result<Vec<Member>, Error> {
    let mut rows = Vec::new();
    if let Some(path) = &lists.roster {
        rows = read_members(path, ListKind::Roster)?;
        check_keys(path, &rows)?;
    }
    for (path, list) in [
        (&lists.canvas, ListKind::Canvas),
        (&lists.moodle, ListKind::Moodle),
        (&lists.gradescope, ListKind::Gradescope),
    ] {
        if let Some(path) = path {
            rows.extend(read_members(path, list)?);
        }
    }
    Ok(rows)
}

/// Fills in unknown fields of `people` from the rows of lists. A row may add an identifier that
/// matches another row, regardless of their order.
pub fn fill_in(rows: &[Member], people: &mut [&mut Person]) {
    for person in people {
        loop {
            let known = person.clone();
            for row in rows {
                if row.matches(person) {
                    person.fill_missing_from(&row.person);
                }
            }
            if **person == known {
                break;
            }
        }
    }
}

/// Returns the people on the lists who match nobody in `people`, without duplicates.
pub fn missing(rows: &[Member], people: &[&Person]) -> Vec<Person> {
    let is_there = |row: &&Member| {
        let is_theirs =
            |person: &&Person| row.matches(person) || is_repetition(&row.person, person);
        people.iter().any(is_theirs)
    };
    let absent: Vec<Member> = rows.iter().filter(|row| !is_there(row)).cloned().collect();
    let mut missing: Vec<Person> = Vec::new();
    for row in &absent {
        let mut person = row.person.clone();
        fill_in(&absent, &mut [&mut person]);
        let is_same = |other: &Person| other.matches(&person) || *other == person;
        if !missing.iter().any(is_same) {
            missing.push(person);
        }
    }
    missing
}

#[cfg(test)]
mod tests;
