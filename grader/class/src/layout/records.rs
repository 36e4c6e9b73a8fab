//! Reads the people and times that platforms write into files: Blackboard's receipts, and the files
//! that Sakai writes into each submission's folder.

use std::collections::{BTreeMap, BTreeSet};

use grader::files;

use super::names::SubmissionNode;
use super::platforms::{Platform, Record};
use super::template::{Parts, read_members};
use super::times::normalize_time;
use crate::entry::{Entry, Person};
use crate::error::Error;
use crate::file_tree::Node;

/// Sakai's folder for the files that a student handed in. Folders next to it contain feedback.
pub const SAKAI_ATTACHMENTS: &str = "Submission attachment(s)";
/// Sakai's file with the submission time.
pub const SAKAI_TIME: &str = "timestamp.txt";
/// Sakai's file with the members of a group.
pub const SAKAI_MEMBERS: &str = "members.txt";

/// The people and the time of a submission, as recorded by the platform. Unknown fields are empty.
#[derive(Debug, Default)]
pub(super) struct SubmissionRecord {
    pub people: Vec<Person>,
    pub time: Option<String>,
}

impl SubmissionRecord {
    /// Adds the recorded information to an entry.
    pub fn describe(self, mut entry: Entry) -> Entry {
        if !self.people.is_empty() {
            entry.info.people = self.people;
        }
        entry.info.submitted = self.time.or(entry.info.submitted);
        entry
    }
}

/// The people in Blackboard's receipts, keyed by the prefix that the names of a submission's files
/// share. Several attempts can have the same prefix. The account is the last part of it.
#[derive(Debug, Default)]
pub(super) struct Receipts<'a>(BTreeMap<&'a str, (&'a str, Person)>);

impl<'a> Receipts<'a> {
    /// Reads the receipts of all submissions.
    pub fn read(
        platform: &Platform,
        groups: &BTreeMap<Parts<'a>, Vec<SubmissionNode<'a>>>,
    ) -> Result<Self, Error> {
        let mut receipts = Receipts::default();
        for (parts, group) in groups.iter().filter(|_| platform.record == Record::Receipt) {
            let text = group.iter().find(|found| found.is_text);
            let text = read_text(text.map(|text| text.node))?.unwrap_or_default();
            let whole = parts.get("whole_name");
            let person = read_receipt(&text, whole);
            receipts.0.extend(person.map(|person| (whole, person)));
        }
        Ok(receipts)
    }

    /// Returns the record of a submission and corrects its account. An attempt without a receipt is
    /// by the person whose other attempts begin with the same name. If there are none, the account
    /// begins where it does in the other submissions, which have the same title.
    pub fn record(&self, parts: &mut Parts<'a>) -> SubmissionRecord {
        let whole = parts.get("whole_name");
        if let Some((account, person)) = self.0.get(whole) {
            parts.set("account", account);
            return SubmissionRecord {
                people: vec![person.clone()],
                time: None,
            };
        }
        let titles = self.0.iter();
        let titles = titles.map(|(whole, (account, _))| whole.strip_suffix(account));
        let titles: BTreeSet<&str> = titles.flatten().collect();
        let account = titles.first().and_then(|title| whole.strip_prefix(title));
        if let Some(account) = account.filter(|own| titles.len() == 1 && !own.is_empty()) {
            parts.set("account", account);
        }
        SubmissionRecord::default()
    }
}

/// Returns the account and the person in the first line of Blackboard's text file, `Name: Jane Doe
/// (jdoe)`, where the word before the colon depends on the language. The assignment's title and the
/// account may contain `_`, so only this line shows where the account begins in the name `whole`.
fn read_receipt<'a>(text: &str, whole: &'a str) -> Option<(&'a str, Person)> {
    let (_, name) = text.lines().next()?.split_once(": ")?;
    let (name, account) = name.trim().strip_suffix(')')?.rsplit_once(" (")?;
    let title = whole.strip_suffix(account)?;
    let person = Person {
        login: account.to_owned(),
        ..Person::named(name.trim())
    };
    let is_account = title.is_empty() || title.ends_with('_');
    is_account.then_some((&whole[title.len()..], person))
}

/// Reads the files that Sakai writes into each folder.
pub(super) fn read_files_in_folder(
    parts: &Parts,
    files: &[SubmissionNode],
) -> Result<SubmissionRecord, Error> {
    let read = |name| read_text(files.iter().find_map(|found| found.node.find(name)));
    let members = read(SAKAI_MEMBERS)?.map(|text| decode_entities(&text));
    let members = read_members(members.as_deref().unwrap_or(parts.get("members")).trim());
    let people = members.unwrap_or_default().into_iter().map(|parts| Person {
        login: parts.get("eid").to_owned(),
        ..Person::named_by_file(parts.fill_first(&["{first} {last}", "{last}", "{first}"]))
    });
    let people = people.collect();
    let time = read(SAKAI_TIME)?.map(|text| text.trim().to_owned());
    let time = time.map(|text| normalize_time(&text).unwrap_or(text));
    Ok(SubmissionRecord { people, time })
}

/// Replaces entities such as `&#252;`, which Sakai writes for each UTF-16 unit outside ASCII.
fn decode_entities(text: &str) -> String {
    let mut units: Vec<u16> = Vec::new();
    for (index, part) in text.split("&#").enumerate() {
        let entity = part.split_once(';').filter(|_| index > 0);
        let entity = entity.and_then(|(unit, rest)| Some((unit.parse().ok()?, rest)));
        let (before, rest) = if index > 0 { ("&#", part) } else { ("", part) };
        match entity {
            Some((unit, rest)) => units.extend([unit].into_iter().chain(rest.encode_utf16())),
            None => units.extend(before.encode_utf16().chain(rest.encode_utf16())),
        }
    }
    String::from_utf16_lossy(&units)
}

/// Reads a file written by the platform. Links are not followed, since they may lead anywhere.
fn read_text(node: Option<&Node>) -> Result<Option<String>, Error> {
    let Some(file) = node.filter(|node| !node.is_folder() && !node.is_link) else {
        return Ok(None);
    };
    let bytes = files::read(&file.path).map_err(Error::user)?;
    let text = String::from_utf8_lossy(&bytes);
    Ok(Some(text.trim_start_matches('\u{feff}').to_owned()))
}
