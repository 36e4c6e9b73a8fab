//! Who is in the class, from whatever list there is: its columns are recognised by their names.

use std::path::Path;

use crate::cli::Lists;
use crate::entry::{EntryInfo, Person};
use crate::table::{Table, TableError};

/// What platforms and people call a column, for each thing that we know of a person.
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
/// When it was handed in: classroom50's and GitHub Classroom's.
const SUBMISSION_TIME: [&str; 2] = ["datetime", "submission_timestamp"];
const GROUP: [&str; 4] = ["group", "group name", "group_name", "team"];

/// What Canvas writes into its gradebook that is nobody.
const PLACEHOLDER_NAMES: [&str; 2] = ["Points Possible", "Student, Test"];

/// One line of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Who.
    pub person: Person,
    /// In which group. Empty where the list says nothing of it.
    pub group: String,
    /// When it was handed in, in the list's own words. Empty where it says nothing of it.
    pub submitted: String,
    /// Whether the list calls that late.
    pub late: bool,
    /// Whether the list has another of this name, which then tells neither.
    has_namesake: bool,
}

impl Member {
    /// Whether that is this person.
    pub fn matches(&self, person: &Person) -> bool {
        person.matches(&self.person) || self.matches_by_name(person)
    }

    /// A person who has nothing but a name, which is all that a folder tells, is known by that; but
    /// not where both have the platform's number, and it differs.
    fn matches_by_name(&self, person: &Person) -> bool {
        let known = &self.person;
        let is_bare = [&person.email, &person.sid, &person.login]
            .iter()
            .all(|text| text.is_empty());
        let is_numbered = !person.number.is_empty() && !known.number.is_empty();
        let name = (!self.has_namesake).then_some(&known.name);
        let names = [&known.login, &known.sid, &known.email];
        let mut names = names.into_iter().chain(name);
        let same = |known: &String| !known.is_empty() && equals_ignoring_case(known, &person.name);
        is_bare && !is_numbered && names.any(same)
    }

    fn is_namesake_of(&self, other: &Member) -> bool {
        let (one, other) = (&self.person, &other.person);
        equals_ignoring_case(&one.name, &other.name) && !one.matches(other) && one != other
    }
}

/// Tells entries when they were handed in, where the roster says so and the platform's files do not.
pub fn set_submission_times(
    lists: &Lists,
    entries: &mut [&mut EntryInfo],
) -> Result<(), TableError> {
    let Some(path) = &lists.roster else {
        return Ok(());
    };
    let members = read_members(path)?;
    for about in entries.iter_mut().filter(|about| about.submitted.is_none()) {
        let theirs = members.iter().filter(|member| {
            let mut people = about.people.iter();
            !member.submitted.is_empty() && people.any(|person| member.matches(person))
        });
        // Of several the last is the one that was cloned. ISO 8601 is in order as it stands.
        if let Some(last) = theirs.max_by_key(|member| &member.submitted) {
            about.submitted = Some(last.submitted.clone());
            about.late = last.late;
        }
    }
    Ok(())
}

fn equals_ignoring_case(one: &str, other: &str) -> bool {
    one.to_lowercase() == other.to_lowercase()
}

/// The people in a list: a roster, or what a platform gives out to keep grades in.
pub fn read_members(path: &Path) -> Result<Vec<Member>, TableError> {
    parse_members(&Table::read(path)?).ok_or_else(|| TableError::MissingColumn {
        path: path.to_owned(),
        column: "that tells who is who".to_owned(),
        remedy: "name its columns name, email, sid, username".to_owned(),
    })
}

fn parse_members(table: &Table) -> Option<Vec<Member>> {
    let column = |names: &[&str]| names.iter().find_map(|name| table.column(name));
    let [name, first, last] = [column(&NAME), column(&FIRST), column(&LAST)];
    let [email, sid, login] = [column(&EMAIL), column(&SID), column(&LOGIN)];
    let group = column(&GROUP);
    let [moment, late] = [column(&SUBMISSION_TIME), table.column("late")];
    // Nothing else joins it with submissions.
    email.or(sid).or(login).or(name)?;
    // The platforms' own numbers, in the lists that can be told to be theirs.
    let number = match table.column("Student") {
        Some(_) => table.column("ID"),
        None => table
            .column("Identifier")
            .or_else(|| table.column("canvas_user_id")),
    };
    let member = |row: &Vec<String>| {
        let cell = |column: Option<usize>| {
            let cell = column.and_then(|column| row.get(column));
            cell.map(|cell| cell.trim().to_owned()).unwrap_or_default()
        };
        let full = match cell(name) {
            name if name.is_empty() => format!("{} {}", cell(first), cell(last)).trim().to_owned(),
            name => name,
        };
        let person = Person {
            name: full,
            email: cell(email),
            sid: cell(sid),
            login: cell(login),
            // Moodle's stands behind a word of the site's language.
            number: cell(number)
                .rsplit(' ')
                .next()
                .unwrap_or_default()
                .to_owned(),
        };
        Member {
            person,
            group: cell(group),
            submitted: cell(moment),
            late: cell(late).eq_ignore_ascii_case("true"),
            has_namesake: false,
        }
    };
    let members = table.rows.iter().map(member);
    let is_somebody = |Member { person, .. }: &Member| {
        !person.display_name().is_empty() && !PLACEHOLDER_NAMES.contains(&person.name.as_str())
    };
    let mut members: Vec<Member> = members.filter(is_somebody).collect();
    let namesakes: Vec<bool> = members
        .iter()
        .map(|one| members.iter().any(|other| one.is_namesake_of(other)))
        .collect();
    for (member, has_namesake) in members.iter_mut().zip(namesakes) {
        member.has_namesake = has_namesake;
    }
    Some(members)
}

/// Tells people what the lists know of them; returns those of the lists who are not among them.
pub fn join(lists: &Lists, people: &mut [&mut Person]) -> Result<Vec<Person>, TableError> {
    let files = [
        &lists.roster,
        &lists.canvas,
        &lists.moodle,
        &lists.gradescope,
    ];
    let mut missing: Vec<Person> = Vec::new();
    for path in files.into_iter().flatten() {
        for known in read_members(path)? {
            let mut count = 0;
            for person in people.iter_mut() {
                if known.matches(person) {
                    person.fill_missing_from(&known.person);
                    count += 1;
                }
            }
            if count == 0 && !missing.iter().any(|other| other.matches(&known.person)) {
                missing.push(known.person);
            }
        }
    }
    Ok(missing)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse_roster(table: &str) -> Vec<Member> {
        parse_members(&Table::parse(table.as_bytes()).unwrap()).unwrap()
    }

    #[test]
    fn an_ambiguous_name_matches_nobody() {
        let ann = Person::named("Ann Lee");
        let list = parse_roster("name,email\nAnn Lee,a@x.edu\nann lee,b@x.edu\nBob,c@x.edu\n");
        assert!(!list[0].matches(&ann) && !list[1].matches(&ann));
        assert!(list[2].matches(&Person::named("bob")));
        // The same person in two sections is one.
        let list = parse_roster("name,email\nAnn Lee,a@x.edu\nAnn Lee,A@x.edu\n");
        assert!(list[0].matches(&ann));
        // An account is one person's, whatever the name.
        let list = parse_roster("name,username\nAnn Lee,ann1\nAnn Lee,ann2\n");
        let named = |name| {
            list.iter()
                .filter(|m| m.matches(&Person::named(name)))
                .count()
        };
        assert_eq!((named("ann2"), named("Ann Lee")), (1, 0));
    }

    #[test]
    fn the_same_name_with_another_number_does_not_match() {
        let worksheet = "Identifier,Full name,Email address\nParticipant 307,Ann Lee,a@x.edu\n";
        let list = parse_roster(worksheet);
        let numbered = |number: &str| Person {
            number: number.to_owned(),
            ..Person::named("Ann Lee")
        };
        assert!(list[0].matches(&numbered("307")));
        assert!(!list[0].matches(&numbered("308")));
    }
}
