//! The entries of a class, in a form that doesn't depend on the layout.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::names::{are_alike, are_equal, are_same_name, given_name_first, joined};

/// The placeholder in [`EntryInfo::hand_back_as`] that stands for people's names.
pub const WHO: &str = "{who}";
/// The placeholder in [`EntryInfo::hand_back_as`] that stands for a person's number. If the file
/// name contains this placeholder, each person gets a separate page.
pub const NUMBER: &str = "{number}";

/// One submission of a class, before its files are read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The id, which is unique in the class. It is also the name of the folder with the results.
    pub id: String,
    /// Information about the submission, such as who handed it in.
    pub info: EntryInfo,
    /// The location of the submission's files.
    pub source: Source,
}

/// Information about a submission, which is stored with its result.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct EntryInfo {
    /// The people who get the points. There is always at least one.
    pub people: Vec<Person>,
    /// Whether the platform's export marks the submission as late.
    pub late: bool,
    /// Whether the platform's export flags every late submission. If so, a submission without a
    /// flag is on time.
    pub marks_late: bool,
    /// Whether corrected files, which were handed in later, have replaced the original ones.
    pub is_corrected: bool,
    /// Whether there is nothing to grade because of a problem with names or the export that only
    /// staff can correct.
    pub needs_staff: bool,
    /// Why it is unclear who handed in the submission, if it is.
    pub unclear_person: Option<String>,
    /// Whether none of the people is on the lists that staff provided. `false` if there are no
    /// lists or if it is unclear who the people are.
    pub is_unlisted: bool,
    /// The number of this attempt among the attempts by the same people, if the platform counts
    /// attempts.
    pub attempt: Option<u32>,
    /// The submission time from the platform's export, in the platform's format.
    pub submitted: Option<String>,
    /// The submission time from a list, if the export doesn't contain one.
    pub listed: Option<ListedTime>,
    /// The file or folder that the submission was read from, relative to the input.
    pub from: String,
    /// The file name that the platform requires for the page to hand back. In it, `{who}` stands
    /// for people's names, and `{number}` stands for a person's number. `None` if the platform
    /// accepts any name.
    pub hand_back_as: Option<String>,
    /// The pseudonym that graders see, or an empty string if there is none.
    #[serde(skip)]
    pub pseudonym: String,
    /// The group that the submission is named after, if its people were taken from a list of the
    /// group's members.
    pub team: Option<String>,
}

/// The time of a submission in a roster or in a platform's list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListedTime {
    /// The submission time, in the list's format.
    pub submitted: String,
    /// Whether the list marks the submission as late.
    pub late: bool,
}

/// One student as described by the platform. Text is copied unchanged, and unknown fields are
/// empty.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Person {
    /// The full name.
    pub name: String,
    /// The email address.
    pub email: String,
    /// The university's student id.
    pub sid: String,
    /// The account name, for example on GitHub.
    pub login: String,
    /// The number that the platform assigns to the person, such as the user id in Canvas or the
    /// participant number in Moodle. In Moodle's file names, it can also be a group's number, which
    /// may coincide with somebody else's personal number, so it is only used together with the
    /// name.
    pub number: String,
    /// The group in the roster.
    pub group: String,
    /// The section or tutor in the roster.
    pub section: String,
    /// The extension in the roster: a number of days or a time.
    pub extension: String,
    /// The status in Moodle's worksheet, which may include an extension.
    pub status: String,
    /// Whether `name` comes from the name of a file or folder. If so, the name on a list is
    /// preferred.
    pub is_named_by_file: bool,
    /// Whether the person was added to the submission only because of the roster's groups.
    pub is_from_group: bool,
    /// Whether the person is on a list, in which case `number` isn't a group's number.
    pub is_listed: bool,
}

impl Entry {
    /// Returns an entry without files, for a submission with a problem that only staff can correct.
    pub fn left_to_staff(name: &str, why: impl Into<String>) -> Self {
        let source = Source::Missing(why.into());
        let mut entry = Entry::new(name, Person::named_by_file(name), name, source);
        entry.info.needs_staff = true;
        entry
    }

    /// Marks the entry as having no files because of a problem that only staff can correct.
    pub fn leave_to_staff(&mut self, why: impl Into<String>) {
        self.source = Source::Missing(why.into());
        self.info.needs_staff = true;
    }

    /// Returns an entry for one person, read from the file or folder `from`.
    pub fn new(id: impl Into<String>, person: Person, from: &str, source: Source) -> Self {
        let info = EntryInfo {
            people: vec![person],
            from: from.to_owned(),
            ..EntryInfo::default()
        };
        let id = id.into();
        Entry { id, info, source }
    }
}

/// The location of an entry's files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A folder or an archive.
    Path(PathBuf),
    /// Individual files: for each file, the name it was handed in under, and its path.
    Files(Vec<(String, PathBuf)>),
    /// Nothing can be graded, for this reason.
    Missing(String),
}

impl Source {
    /// Returns the paths of the folder, the archive or the files.
    pub fn paths(&self) -> Vec<&Path> {
        match self {
            Source::Path(path) => vec![path],
            Source::Files(files) => files.iter().map(|(_, path)| path.as_path()).collect(),
            Source::Missing(_) => Vec::new(),
        }
    }
}

impl Person {
    /// Returns a person known only by the name of a file or folder.
    pub fn named_by_file(name: impl Into<String>) -> Self {
        Person {
            is_named_by_file: true,
            ..Person::named(name)
        }
    }

    /// Returns the identifiers that are unique to one person. Unknown identifiers are empty.
    pub fn own_identifiers(&self) -> [&str; 3] {
        [&self.email, &self.sid, &self.login]
    }

    /// Returns whether none of the person's unique identifiers is known.
    pub fn is_bare(&self) -> bool {
        self.own_identifiers() == [""; 3]
    }

    /// Returns everything that identifies the person, without empty strings.
    pub fn identifiers(&self) -> impl Iterator<Item = &str> + Clone {
        let all = self.own_identifiers().into_iter();
        let all = all.chain([self.own_number(), &self.name]);
        all.filter(|text| !text.is_empty())
    }

    /// Returns the platform's number for the person, or an empty string if the number may be a
    /// group's.
    pub fn own_number(&self) -> &str {
        if self.is_listed { &self.number } else { "" }
    }

    /// Returns whether the person has this number and, if both names are known, a name similar to
    /// `name`. `number` and `name` come from the same record, such as a row of a list. In a list
    /// without names, `name` is text such as `Participant 51`.
    pub fn has_number(&self, number: &str, name: &str) -> bool {
        let numbered = format!("{}{}", self.name, self.number);
        let pairs = [(&*self.name, name), (name, &self.name), (&numbered, name)];
        let mut pairs = pairs.into_iter();
        let is_unknown = self.name.is_empty() || name.is_empty();
        !number.is_empty()
            && self.number == number
            && (is_unknown || pairs.any(|(one, other)| are_alike(one, other)))
    }

    /// Returns whether this is Canvas's test student, which lets teachers see their course as a
    /// student would.
    pub fn is_test_student(&self) -> bool {
        !self.name.is_empty() && are_alike(&self.name, "Test Student")
    }

    /// Returns a person known only by name.
    pub fn named(name: impl Into<String>) -> Self {
        Person {
            name: name.into(),
            ..Person::default()
        }
    }

    /// Returns the name or, if it is unknown, another field that is known.
    pub fn display_name(&self) -> &str {
        let known = [&self.name, &self.login, &self.email, &self.sid];
        let name = known.into_iter().find(|text| !text.is_empty());
        name.unwrap_or(&self.number)
    }

    /// Fills in unknown fields from another record of the same person.
    pub fn fill_missing_from(&mut self, other: &Person) {
        if self.is_named_by_file && !other.name.is_empty() {
            // A roster may contain `Doe, Jane` for a folder named `Jane Doe`.
            let turned = given_name_first(&other.name);
            let is_turned = are_same_name(&turned, &self.name);
            self.name = if is_turned {
                turned
            } else {
                other.name.clone()
            };
            self.is_named_by_file = false;
        }
        self.is_listed |= other.is_listed;
        let pairs = [
            (&mut self.name, &other.name),
            (&mut self.email, &other.email),
            (&mut self.sid, &other.sid),
            (&mut self.login, &other.login),
            (&mut self.number, &other.number),
            (&mut self.group, &other.group),
            (&mut self.section, &other.section),
            (&mut self.extension, &other.extension),
            (&mut self.status, &other.status),
        ];
        for (mine, theirs) in pairs {
            if mine.is_empty() {
                mine.clone_from(theirs);
            }
        }
    }

    /// Returns whether both records describe the same person. They must share a unique identifier,
    /// or they must have the same number and, if both names are known, similar names. A name on its
    /// own is never enough, since two people may share it.
    pub fn matches(&self, other: &Person) -> bool {
        let pairs = self.own_identifiers().into_iter();
        let mut pairs = pairs.zip(other.own_identifiers());
        pairs.any(|(mine, theirs)| !mine.is_empty() && are_equal(mine, theirs))
            || self.has_number(&other.number, &other.name)
    }

    /// Returns whether both records describe the same person, or can only be compared by name and
    /// have the same name.
    pub fn is_same(&self, other: &Person) -> bool {
        let has_only_name = |person: &Person| person.is_bare() && person.number.is_empty();
        let is_namesake = !self.name.is_empty() && are_equal(&self.name, &other.name);
        self.matches(other)
            || self == other
            || (is_namesake && has_only_name(self) && has_only_name(other))
    }
}

impl EntryInfo {
    /// Returns the submission time, in the format of the platform or list that it comes from.
    pub fn submitted(&self) -> Option<&str> {
        let listed = self.listed.as_ref().map(|listed| &listed.submitted);
        self.submitted.as_ref().or(listed).map(String::as_str)
    }

    /// Returns whether the platform or a list marks the submission as late.
    pub fn is_late(&self) -> bool {
        self.late || self.listed.as_ref().is_some_and(|listed| listed.late)
    }

    /// Removes the groups and extensions, which only come from rosters. This is needed when a
    /// different roster is used.
    pub fn forget_groups_and_extensions(&mut self) {
        if let Some(team) = self.team_record() {
            self.people = vec![team];
        }
        self.people.retain(|person| !person.is_from_group);
        for person in &mut self.people {
            person.group.clear();
            person.extension.clear();
        }
    }

    /// Returns the record of the group that the submission is named after, which may have a row in a
    /// list.
    pub fn team_record(&self) -> Option<Person> {
        self.team.as_ref().map(Person::named_by_file)
    }

    /// Returns the names of all people, joined with ` + `.
    pub fn display_names(&self) -> String {
        joined(self.people.iter().map(Person::display_name), " + ")
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::graded_class::tests::person;

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

    #[test]
    fn a_number_counts_only_with_the_name() {
        let with_number = |name: &str| person(json!({ "name": name, "number": "51" }));
        for (one, other) in [
            ("Ann Lee", "Lee, Ann"),
            ("", "Ann Lee"),
            ("Teilnehmerin", "Teilnehmer/in 51"),
        ] {
            let (one, other) = (with_number(one), with_number(other));
            assert!(one.matches(&other), "{one:?} {other:?}");
        }
        assert!(!with_number("Team A").matches(&with_number("Ann Lee")));
        let mut unlisted = with_number("Team A");
        assert!(!unlisted.identifiers().any(|text| text == "51"));
        unlisted.is_listed = true;
        assert!(unlisted.identifiers().any(|text| text == "51"));
    }

    #[test]
    fn what_is_not_known_identifies_nobody() {
        let ann = person(json!({ "name": "Ann", "sid": "17" }));
        assert_eq!(ann.identifiers().collect::<Vec<_>>(), ["17", "Ann"]);
        assert_eq!(Person::default().identifiers().next(), None);
    }

    #[test]
    fn another_roster_counts_for_groups_and_extensions() {
        let listed = person(json!({ "name": "Ann", "group": "Team A", "extension": "2" }));
        let of_group = person(json!({ "name": "Bob", "is_from_group": true }));
        let mut info = EntryInfo {
            people: vec![listed, of_group],
            ..EntryInfo::default()
        };
        info.forget_groups_and_extensions();
        assert_eq!(info.people, [Person::named("Ann")]);
    }

    #[test]
    fn a_name_in_a_list_replaces_only_that_of_a_file() {
        let filled = |mut person: Person, name: &str| {
            person.fill_missing_from(&Person::named(name));
            (person.name, person.is_named_by_file)
        };
        let by_file = || Person::named_by_file("lee_ann");
        assert_eq!(filled(by_file(), "Ann Lee"), ("Ann Lee".to_owned(), false));
        assert_eq!(filled(by_file(), ""), ("lee_ann".to_owned(), true));
        let named = Person::named("Ann");
        assert_eq!(filled(named, "Ann Lee"), ("Ann".to_owned(), false));
    }
}
