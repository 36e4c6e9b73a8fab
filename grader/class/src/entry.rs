//! Who handed in what: what every layout is read into.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// One submission of a class, before it is looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Unique in the class, and the name of the folder with its results.
    pub id: String,
    /// Whose it is, as far as is known.
    pub info: EntryInfo,
    /// Where its files are.
    pub source: Source,
}

/// What results say of an entry.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct EntryInfo {
    /// Those who get the points. At least one.
    pub people: Vec<Person>,
    /// What the platform says of when it came.
    pub late: bool,
    /// When it came, in the platform's own words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub submitted: Option<String>,
    /// Where it was found, relative to the input.
    pub from: String,
}

/// One student, as far as the platform tells. Text as it stands there.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Person {
    /// As people write it.
    pub name: String,
    /// The address.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub email: String,
    /// The university's number.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub sid: String,
    /// The account, such as at GitHub.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub login: String,
    /// The platform's own number: Canvas's user, Moodle's participant.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub number: String,
}

/// Where an entry's files are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A folder or an archive.
    Path(PathBuf),
    /// Single files, each with the name that it was handed in by.
    Files(Vec<(String, PathBuf)>),
    /// There are none, and why.
    Missing(String),
}

impl Person {
    /// With a name and nothing else.
    pub fn named(name: impl Into<String>) -> Self {
        Person {
            name: name.into(),
            ..Person::default()
        }
    }

    /// What people read: the name, else whatever is known.
    pub fn display_name(&self) -> &str {
        let known = [&self.name, &self.login, &self.email, &self.sid];
        let words = known.into_iter().find(|text| !text.is_empty());
        words.unwrap_or(&self.number)
    }

    /// Takes over what another list knows of the same person.
    pub fn fill_missing_from(&mut self, other: &Person) {
        let pairs = [
            (&mut self.name, &other.name),
            (&mut self.email, &other.email),
            (&mut self.sid, &other.sid),
            (&mut self.login, &other.login),
            (&mut self.number, &other.number),
        ];
        for (mine, theirs) in pairs {
            if mine.is_empty() {
                mine.clone_from(theirs);
            }
        }
    }

    /// Whether both lists mean the same person: by what is one person's alone, never by name.
    pub fn matches(&self, other: &Person) -> bool {
        let pairs = [
            (&self.email, &other.email),
            (&self.sid, &other.sid),
            (&self.login, &other.login),
            (&self.number, &other.number),
        ];
        let same = |(mine, theirs): &(&String, &String)| {
            !mine.is_empty() && mine.to_lowercase() == theirs.to_lowercase()
        };
        pairs.iter().any(same)
    }
}

impl EntryInfo {
    /// All names, for people.
    pub fn display_names(&self) -> String {
        let names: Vec<&str> = self.people.iter().map(Person::display_name).collect();
        names.join(" + ")
    }
}

/// Why nobody is graded from several archives.
pub fn several_archives_message(count: usize) -> String {
    format!("{count} archives were handed in: keep the one that counts")
}

/// A name for a folder that any system takes, and that links can hold: letters and digits of any
/// language, and a few signs.
pub fn folder_name(text: &str) -> String {
    let plain = |c: char| match c {
        c if c.is_alphanumeric() || "-_.".contains(c) => c,
        _ => '_',
    };
    let name: String = text.chars().map(plain).take(80).collect();
    match name.trim_matches('.') {
        "" => "_".to_owned(),
        name => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folder_name_replaces_unsafe_characters() {
        assert_eq!(folder_name("../é ü/x:y"), "_é_ü_x_y");
        assert_eq!(folder_name(".."), "_");
        assert_eq!(folder_name("=cmd|' /C calc'!A0"), "_cmd____C_calc__A0");
    }

    #[test]
    fn people_match_by_identifier_and_not_by_name() {
        let mut one = Person::named("Ann Lee");
        let other = Person {
            email: "Ann@x.edu".to_owned(),
            ..one.clone()
        };
        assert!(!one.matches(&other));
        one.email = "ann@x.edu".to_owned();
        assert!(one.matches(&other));
    }
}
