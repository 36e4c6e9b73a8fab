//! Who is in the class, from whatever list there is: its columns are recognised by their names.

use std::path::Path;

use crate::cli::Lists;
use crate::entry::Person;
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
}

impl Member {
    /// Whether that is this person.
    pub fn is(&self, person: &Person) -> bool {
        person.is(&self.person) || is_named(person, &self.person)
    }
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
        }
    };
    let members = table.rows.iter().map(member);
    let is_somebody = |Member { person, .. }: &Member| {
        !person.words().is_empty() && !NOBODY.contains(&person.name.as_str())
    };
    Some(members.filter(is_somebody).collect())
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

/// A person who has nothing but a name, which is all that a folder tells, is known by that.
fn is_named(person: &Person, known: &Person) -> bool {
    let bare = person.email.is_empty() && person.sid.is_empty() && person.login.is_empty();
    let names = [&known.name, &known.login, &known.sid, &known.email];
    let name = person.name.to_lowercase();
    bare && names
        .iter()
        .any(|known| !known.is_empty() && known.to_lowercase() == name)
}
