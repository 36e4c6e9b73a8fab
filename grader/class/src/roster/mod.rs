//! Reads the people of a class from a roster or gradebook. Columns are recognised by their names.

mod times;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::LazyLock;

use crate::cli::Lists;
use crate::entry::Person;
use crate::error::Error;
use crate::list_kind::ListKind;
use crate::moodle_status::MoodleStatus;
use crate::names::{are_equal, are_same_name, fold, given_name_first, number_at_end};
use crate::table::{Table, missing_column};

pub use times::set_submission_times;

/// The column names from `columns.toml`, keyed by field.
static COLUMNS: LazyLock<BTreeMap<String, Vec<String>>> =
    LazyLock::new(|| toml::from_str(include_str!("columns.toml")).expect("the file is valid"));

/// The maximum number of rows above the header. Sakai writes the assignment's title there.
const MAX_ROWS_ABOVE: usize = 3;

/// The name that Canvas's gradebook gives to the row with the maximum points.
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

    /// Returns whether the person's name is the name or an identifier in this row. The name is only
    /// compared if the person's email address, student id and account name are unknown, e.g. for a
    /// folder named after a student. If both the row and the person have a platform number, the
    /// numbers must be the same, and the person's name must be an identifier in the row.
    fn matches_by_name(&self, person: &Person) -> bool {
        if !person.is_bare() {
            return false;
        }
        let known = &self.person;
        let is_numbered = !person.number.is_empty() && !known.number.is_empty();
        let mut identifiers = known.own_identifiers().into_iter();
        let is_identified = (!is_numbered || person.number == known.number)
            && identifiers.any(|own| !own.is_empty() && are_equal(own, &person.name));
        let is_named = !is_numbered && !self.has_namesake && self.is_called(person);
        is_identified || is_named
    }

    /// Returns whether the name in this row matches the person's.
    fn is_called(&self, person: &Person) -> bool {
        let known = &self.person.name;
        !known.is_empty() && are_same_in_any_order(known, &person.name)
    }

    /// Returns whether the person is known only by a name that several people in this row's list
    /// share.
    pub fn is_namesake(&self, person: &Person) -> bool {
        self.has_namesake && person.is_bare() && self.is_called(person)
    }

    fn is_namesake_of(&self, other: &Member) -> bool {
        let (one, other) = (&self.person, &other.person);
        are_same_in_any_order(&one.name, &other.name) && !one.matches(other) && one != other
    }
}

/// Returns whether two names are the same. Either can be written as `Doe, Jane`.
fn are_same_in_any_order(one: &str, other: &str) -> bool {
    let is_turned =
        |one: &str, other: &str| one.contains(',') && are_same_name(&given_name_first(one), other);
    are_same_name(one, other) || is_turned(one, other) || is_turned(other, one)
}

/// Reads the people in a roster or in a platform's gradebook.
fn read_members(path: &Path, list: ListKind) -> Result<Vec<Member>, Error> {
    let remedy = "it needs at least one of the columns name, email, sid and username; column \
        headings in other languages are not recognised";
    let table = Table::read(path)?;
    let tables = (0..=MAX_ROWS_ABOVE).map_while(|rows| table.below(rows));
    let mut members = tables.filter_map(|table| parse_members(&table, list));
    let members = members.next();
    members.ok_or_else(|| missing_column(path, "that identifies people", remedy))
}

fn parse_members(table: &Table, list: ListKind) -> Option<Vec<Member>> {
    let column = |field: &str| COLUMNS[field].iter().find_map(|name| table.column(name));
    // Moodle writes a word in the site's language before the number.
    let identifier = table.column("Identifier");
    let login = match table.column("Display ID") {
        // This is Sakai's list of grades. The displayed id can differ from the account name.
        Some(_) => table.column("ID"),
        None => column("login"),
    };
    // A list needs one of these columns to match its rows with submissions.
    let names = ["email", "sid", "name"].into_iter().find_map(column);
    names.or(login).or(identifier)?;
    // Use the platform's numbers if the list is recognised as Canvas's or Moodle's.
    let is_canvas = table.column("Student").is_some();
    let number = if is_canvas {
        table.column("ID")
    } else {
        identifier.or_else(|| table.column("canvas_user_id"))
    };
    // Brightspace's list of grades has a `#` before each identifier, so that spreadsheets don't
    // turn the identifiers into numbers.
    let is_marked = table.column("End-of-Line Indicator").is_some();
    // In other lists, a status column means something else.
    let status = identifier.and(table.column("Status"));
    let member = |(row_number, row): (usize, &Vec<String>)| {
        let cell = |column: Option<usize>| {
            let cell = column.and_then(|column| row.get(column));
            let cell = cell.map(|cell| cell.trim()).unwrap_or_default();
            let unmarked = cell.strip_prefix('#').filter(|_| is_marked);
            unmarked.unwrap_or(cell).to_owned()
        };
        let text = |field: &str| cell(column(field));
        let name = match text("name") {
            name if is_canvas => given_name_first(&name),
            name => name,
        };
        let parts = format!("{} {}", text("first"), text("last"));
        // With blind marking, the list contains no names.
        let names = [name, parts.trim().to_owned(), cell(identifier)];
        let name = names.into_iter().find(|name| !name.is_empty());
        let person = Person {
            name: name.unwrap_or_default(),
            email: text("email"),
            sid: text("sid"),
            login: cell(login),
            number: number_at_end(&cell(number)).to_owned(),
            group: text("group"),
            section: text("section"),
            extension: text("extension"),
            status: cell(status),
            is_listed: true,
            ..Person::default()
        };
        let submitted = Some(text("submission_time"));
        Member {
            list,
            row: row_number,
            // Moodle writes a dash for participants who submitted nothing.
            submitted: submitted.filter(|time| time != "-").unwrap_or_default(),
            late: text("late").eq_ignore_ascii_case("true")
                || MoodleStatus::parse(&person.status).is_late,
            person,
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
    let has_namesake = |one: &Member| members.iter().any(|other| one.is_namesake_of(other));
    let namesakes: Vec<bool> = members.iter().map(has_namesake).collect();
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
                    "{}: rows {} and {} both contain {key:?}, but are otherwise different: correct \
                    one of them",
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
    own.zip(others).all(|(one, other)| are_equal(one, other))
}

/// Reads the people on the list in a platform's download. Returns an empty list if the language of
/// the file isn't supported.
pub fn read_downloaded(path: &Path) -> Vec<Member> {
    let mut members = read_members(path, ListKind::Downloaded).unwrap_or_default();
    // If names are hidden, everybody has the same name.
    if members.iter().all(|member| member.has_namesake) {
        members.clear();
    }
    members
}

/// Reads the people on all lists. A person has one row per list they are on. No two people in the
/// roster may share an identifier.
pub fn read_lists(lists: &Lists) -> Result<Vec<Member>, Error> {
    let mut rows = Vec::new();
    if let Some(path) = &lists.roster {
        rows = read_members(path, ListKind::Roster)?;
        check_keys(path, &rows)?;
    }
    if let Some(path) = &lists.downloaded {
        rows.extend(read_downloaded(path));
    }
    for list in ListKind::GRADEBOOKS {
        if let Some(path) = lists.get(list) {
            rows.extend(read_members(&path, list)?);
        }
    }
    Ok(rows)
}

/// Fills in unknown fields of `people`, using the rows of the lists. A row may add an identifier
/// that matches another row, regardless of the order of the rows.
pub fn fill_in<'a>(rows: &[Member], people: impl IntoIterator<Item = &'a mut Person>) {
    for person in people {
        loop {
            let known = person.clone();
            for row in rows {
                if row.matches(person) {
                    person.fill_missing_from(&row.person);
                }
            }
            if *person == known {
                break;
            }
        }
        // The sections in the teacher's roster take precedence over a platform's sections.
        let mut own = rows.iter().filter(|row| row.list == ListKind::Roster);
        let own = own.find(|row| !row.person.section.is_empty() && row.matches(person));
        if let Some(row) = own {
            person.section.clone_from(&row.person.section);
        }
    }
}

/// Returns the people on the lists who match nobody in `people`, without duplicates. A name that is
/// unique both in the list and in `people` is enough.
pub fn missing(rows: &[Member], people: &[&Person]) -> Vec<Person> {
    let differ =
        |one: &str, other: &str| !one.is_empty() && !other.is_empty() && !are_equal(one, other);
    let is_only_one = |row: &Member, person: &Person| {
        !row.has_namesake
            && row.is_called(person)
            && !differ(&row.person.sid, &person.sid)
            && !differ(&row.person.number, &person.number)
            && people
                .iter()
                .all(|other| !row.is_called(other) || other.is_same(person))
    };
    let is_there = |row: &&Member| {
        let is_theirs = |person: &&Person| {
            row.matches(person) || is_repetition(&row.person, person) || is_only_one(row, person)
        };
        people.iter().any(is_theirs)
    };
    let absent: Vec<Member> = rows.iter().filter(|row| !is_there(row)).cloned().collect();
    let mut missing: Vec<Person> = Vec::new();
    for row in &absent {
        let mut person = row.person.clone();
        fill_in(&absent, [&mut person]);
        let is_same = |other: &Person| other.matches(&person) || *other == person;
        if !missing.iter().any(is_same) {
            missing.push(person);
        }
    }
    missing
}

#[cfg(test)]
mod tests;
