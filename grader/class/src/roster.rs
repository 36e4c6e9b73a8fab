//! Who is in the class, from whatever list there is: its columns are recognised by their names.

use std::path::Path;

use crate::cli::Lists;
use crate::entry::{About, Person};
use crate::table::{BadTable, Table};

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
const MOMENT: [&str; 2] = ["datetime", "submission_timestamp"];
const GROUP: [&str; 4] = ["group", "group name", "group_name", "team"];

/// What Canvas writes into its gradebook that is nobody.
const NOBODY: [&str; 2] = ["Points Possible", "Student, Test"];

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
    pub fn is(&self, person: &Person) -> bool {
        person.is(&self.person) || self.is_named(person)
    }

    /// A person who has nothing but a name, which is all that a folder tells, is known by that; but
    /// not where both have the platform's number, and it differs.
    fn is_named(&self, person: &Person) -> bool {
        let known = &self.person;
        let is_bare = [&person.email, &person.sid, &person.login]
            .iter()
            .all(|text| text.is_empty());
        let is_numbered = !person.number.is_empty() && !known.number.is_empty();
        let name = (!self.has_namesake).then_some(&known.name);
        let names = [&known.login, &known.sid, &known.email];
        let mut names = names.into_iter().chain(name);
        let same = |known: &String| !known.is_empty() && is_same(known, &person.name);
        is_bare && !is_numbered && names.any(same)
    }

    fn is_namesake_of(&self, other: &Member) -> bool {
        let (one, other) = (&self.person, &other.person);
        is_same(&one.name, &other.name) && !one.is(other) && one != other
    }
}

/// Tells entries when they were handed in, where the roster says so and the platform's files do not.
pub fn date(lists: &Lists, entries: &mut [&mut About]) -> Result<(), BadTable> {
    let Some(path) = &lists.roster else {
        return Ok(());
    };
    let members = read(path)?;
    for about in entries.iter_mut().filter(|about| about.submitted.is_none()) {
        let theirs = members.iter().filter(|member| {
            let mut people = about.people.iter();
            !member.submitted.is_empty() && people.any(|person| member.is(person))
        });
        // Of several the last is the one that was cloned. ISO 8601 is in order as it stands.
        if let Some(last) = theirs.max_by_key(|member| &member.submitted) {
            about.submitted = Some(last.submitted.clone());
            about.late = last.late;
        }
    }
    Ok(())
}

fn is_same(one: &str, other: &str) -> bool {
    one.to_lowercase() == other.to_lowercase()
}

/// The people in a list: a roster, or what a platform gives out to keep grades in.
pub fn read(path: &Path) -> Result<Vec<Member>, BadTable> {
    members(&Table::read(path)?).ok_or_else(|| BadTable::Lacks {
        path: path.to_owned(),
        lacks: "that tells who is who".to_owned(),
        remedy: "name its columns name, email, sid, username".to_owned(),
    })
}

fn members(table: &Table) -> Option<Vec<Member>> {
    let column = |names: &[&str]| names.iter().find_map(|name| table.column(name));
    let [name, first, last] = [column(&NAME), column(&FIRST), column(&LAST)];
    let [email, sid, login] = [column(&EMAIL), column(&SID), column(&LOGIN)];
    let group = column(&GROUP);
    let [moment, late] = [column(&MOMENT), table.column("late")];
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
        !person.words().is_empty() && !NOBODY.contains(&person.name.as_str())
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
pub fn join(lists: &Lists, people: &mut [&mut Person]) -> Result<Vec<Person>, BadTable> {
    let files = [
        &lists.roster,
        &lists.canvas,
        &lists.moodle,
        &lists.gradescope,
    ];
    let mut missing: Vec<Person> = Vec::new();
    for path in files.into_iter().flatten() {
        for known in read(path)? {
            let mut count = 0;
            for person in people.iter_mut() {
                if known.is(person) {
                    person.learn(&known.person);
                    count += 1;
                }
            }
            if count == 0 && !missing.iter().any(|other| other.is(&known.person)) {
                missing.push(known.person);
            }
        }
    }
    Ok(missing)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(table: &str) -> Vec<Member> {
        members(&Table::parse(table.as_bytes()).unwrap()).unwrap()
    }

    #[test]
    fn a_name_that_two_have_tells_neither() {
        let ann = Person::named("Ann Lee");
        let list = known("name,email\nAnn Lee,a@x.edu\nann lee,b@x.edu\nBob,c@x.edu\n");
        assert!(!list[0].is(&ann) && !list[1].is(&ann));
        assert!(list[2].is(&Person::named("bob")));
        // The same person in two sections is one.
        let list = known("name,email\nAnn Lee,a@x.edu\nAnn Lee,A@x.edu\n");
        assert!(list[0].is(&ann));
        // An account is one person's, whatever the name.
        let list = known("name,username\nAnn Lee,ann1\nAnn Lee,ann2\n");
        let named = |name| list.iter().filter(|m| m.is(&Person::named(name))).count();
        assert_eq!((named("ann2"), named("Ann Lee")), (1, 0));
    }

    #[test]
    fn where_numbers_differ_the_same_name_is_somebody_elses() {
        let worksheet = "Identifier,Full name,Email address\nParticipant 307,Ann Lee,a@x.edu\n";
        let list = known(worksheet);
        let numbered = |number: &str| Person {
            number: number.to_owned(),
            ..Person::named("Ann Lee")
        };
        assert!(list[0].is(&numbered("307")));
        assert!(!list[0].is(&numbered("308")));
    }
}
