//! Moodle's "Download all submissions": a folder for each participant, with a name such as
//! `Jane Doe_123_assignsubmission_file_`, or files whose names begin like that. The number identifies
//! the participant, as in the grading worksheet, or a group, if groups hand in together. Nothing in
//! the name tells which: only a list does, by the name.

use std::collections::BTreeMap;

use super::{LayoutContents, unmatched_path};
use crate::entry::{Entry, NUMBER, Person, Source, WHO};
use crate::listing::Node;
use crate::names::is_number;

const MARK: &str = "_assignsubmission_";
/// The reason for not grading a participant who submitted text but no files.
const TEXT_ONLY: &str = "text was handed in, but no file";
/// The reason for not grading text from a participant who also submitted files.
const TEXT_BESIDE_FILES: &str = "text; the files handed in with it are graded";

/// The reason for not grading two downloads that were unpacked into one folder.
const SEVERAL: &str = "it is in several folders of this name: keep the one that counts";

/// The parts of a file or folder name in Moodle's download.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct MoodleName<'a> {
    /// The name of the participant or the group; in older versions, of both.
    who: &'a str,
    /// The number of the participant or the group. People without a group have none together.
    number: &'a str,
    /// The type of submission: `file`, or another type such as `onlinetext`.
    kind: &'a str,
    /// The file name, in downloads without folders.
    file: &'a str,
}

/// Parses the name of a file or folder; returns `None` if it is not in Moodle's format.
pub(super) fn parse(name: &str) -> Option<MoodleName<'_>> {
    let (head, tail) = name.split_once(MARK)?;
    let (kind, file) = tail.split_once('_').unwrap_or((tail, ""));
    let (who, number) = match head.rsplit_once('_') {
        Some((who, number)) if is_number(number) => (who, number),
        Some(_) | None => (head, ""),
    };
    (!who.is_empty()).then_some(MoodleName {
        who,
        number,
        kind,
        file,
    })
}

pub(super) fn read(root: &Node) -> LayoutContents {
    let mut people: BTreeMap<(&str, &str), Vec<(MoodleName, &Node)>> = BTreeMap::new();
    let mut others = Vec::new();
    for node in root.children() {
        match parse(&node.name) {
            Some(name) => people
                .entry((name.who, name.number))
                .or_default()
                .push((name, node)),
            None => others.push(unmatched_path(node, "its name is not in Moodle's format")),
        }
    }
    let mut entries = Vec::new();
    for submitted in people.into_values() {
        let is_file = |(name, _): &(MoodleName, &Node)| name.kind == "file";
        let (files, texts): (Vec<_>, Vec<_>) = submitted.into_iter().partition(is_file);
        if files.is_empty() {
            let source = Source::Missing(TEXT_ONLY.to_owned());
            entries.push(entry(&texts[0], source));
            continue;
        }
        let beside = |(_, node): &(MoodleName, &Node)| unmatched_path(node, TEXT_BESIDE_FILES);
        others.extend(texts.iter().map(beside));
        let folder = files.iter().find(|(_, node)| node.is_folder());
        let source = match (folder, files.as_slice()) {
            (Some((_, folder)), [_]) => Source::Path(folder.path.clone()),
            (Some(_), _) => Source::Missing(SEVERAL.to_owned()),
            (None, files) => {
                let files = files.iter();
                let files = files.map(|(name, node)| (name.file.to_owned(), node.path.clone()));
                Source::Files(files.collect())
            }
        };
        entries.push(entry(folder.unwrap_or(&files[0]), source));
    }
    (entries, others)
}

fn entry((name, node): &(MoodleName, &Node), source: Source) -> Entry {
    let numbered = |sign: char| match name.number {
        "" => name.who.to_owned(),
        number => format!("{}{sign}{number}", name.who),
    };
    let person = Person {
        // With blind marking, only the number is known.
        name: match name.who {
            "Participant" => numbered(' '),
            who => who.to_owned(),
        },
        number: name.number.to_owned(),
        ..Person::default()
    };
    // With the number, the id stays the same when a namesake hands something in.
    let mut entry = Entry::new(numbered('_'), person, &node.name, source);
    entry.info.hand_back_as = Some(format!("{WHO}_{NUMBER}_assignfeedback_file_feedback.html"));
    entry
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_participant_and_file_name() {
        let name = parse("José Núñez, Jr._123_assignsubmission_file_my_camera.rs").unwrap();
        assert_eq!((name.who, name.number), ("José Núñez, Jr.", "123"));
        assert_eq!((name.kind, name.file), ("file", "my_camera.rs"));
        let folder = parse("Participant_7_assignsubmission_file").unwrap();
        assert_eq!(
            (folder.who, folder.number, folder.file),
            ("Participant", "7", "")
        );
        let default_group = parse("Default group_assignsubmission_file_").unwrap();
        assert_eq!(
            (default_group.who, default_group.number),
            ("Default group", "")
        );
        assert_eq!(parse("_assignsubmission_file_"), None);
    }
}
