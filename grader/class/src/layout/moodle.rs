//! Moodle's "Download all submissions": `Jane Doe_123_assignsubmission_file_`, a folder or the
//! beginning of a file's name. The number is the participant's, which the worksheet has as well.

use std::collections::BTreeMap;

use super::{LayoutContents, is_task_file, unmatched_path};
use crate::entry::{Entry, EntryInfo, Person, Source, several_archives_message};
use crate::listing::Node;

const MARK: &str = "_assignsubmission_";
/// Of somebody whose text is all there is.
const TEXT_ONLY: &str = "a text was handed in, and no file";
/// Of a text of somebody who handed in files as well.
const TEXT_BESIDE_FILES: &str = "a text, beside files: those are graded";

/// What a name tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct MoodleName<'a> {
    /// With the group in front, where there are groups.
    who: &'a str,
    participant: &'a str,
    /// `file`, or another way of handing in.
    kind: &'a str,
    /// The file, in downloads without folders.
    file: &'a str,
}

/// None if it is not such a name.
pub(super) fn parse(name: &str) -> Option<MoodleName<'_>> {
    let (head, tail) = name.split_once(MARK)?;
    let (way, file) = tail.split_once('_').unwrap_or((tail, ""));
    let (who, participant) = head.rsplit_once('_')?;
    let is_number = !participant.is_empty() && participant.bytes().all(|b| b.is_ascii_digit());
    is_number.then_some(MoodleName {
        who,
        participant,
        kind: way,
        file,
    })
}

pub(super) fn read(root: &Node) -> LayoutContents {
    let mut people: BTreeMap<&str, Vec<(MoodleName, &Node)>> = BTreeMap::new();
    let mut others = Vec::new();
    for node in root.children() {
        match parse(&node.name) {
            Some(name) => people
                .entry(name.participant)
                .or_default()
                .push((name, node)),
            None => others.push(unmatched_path(node, "its name is not one of Moodle's")),
        }
    }
    let mut entries = Vec::new();
    for found in people.into_values() {
        let is_file = |(name, _): &(MoodleName, &Node)| name.kind == "file";
        let (files, texts): (Vec<_>, Vec<_>) = found.into_iter().partition(is_file);
        if files.is_empty() {
            let source = Source::Missing(TEXT_ONLY.to_owned());
            entries.push(entry(&texts[0], source));
            continue;
        }
        let beside = |(_, node): &(MoodleName, &Node)| unmatched_path(node, TEXT_BESIDE_FILES);
        others.extend(texts.iter().map(beside));
        let (first, source) = choose_source(&files);
        entries.push(entry(first, source));
    }
    (entries, others)
}

/// What of one participant's files is graded, by the same rule as if they lay in a folder, and
/// which of them it is called by.
fn choose_source<'f, 'n>(
    files: &'f [(MoodleName<'n>, &'n Node)],
) -> (&'f (MoodleName<'n>, &'n Node), Source) {
    let path = |(_, node): &(MoodleName, &Node)| Source::Path(node.path.clone());
    if let Some(folder) = files.iter().find(|(_, node)| node.is_folder()) {
        return (folder, path(folder));
    }
    let is_one = |(name, _): &&(MoodleName, &Node)| is_task_file(name.file);
    let archives: Vec<_> = files.iter().filter(|(_, node)| node.is_archive()).collect();
    match (files.iter().find(is_one), archives.as_slice()) {
        (None, [only]) => (only, path(only)),
        (None, [first, ..]) => (
            first,
            Source::Missing(several_archives_message(archives.len())),
        ),
        (Some(_), _) | (None, []) => {
            let named =
                |(name, node): &(MoodleName, &Node)| (name.file.to_owned(), node.path.clone());
            (&files[0], Source::Files(files.iter().map(named).collect()))
        }
    }
}

fn entry((name, node): &(MoodleName, &Node), source: Source) -> Entry {
    Entry {
        id: format!("{}_{}", name.who, name.participant),
        info: EntryInfo {
            people: vec![Person {
                // Where marking is blind, the number is all that there is.
                name: match name.who {
                    "Participant" => format!("Participant {}", name.participant),
                    who => who.to_owned(),
                },
                number: name.participant.to_owned(),
                ..Person::default()
            }],
            from: node.name.clone(),
            ..EntryInfo::default()
        },
        source,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_participant_and_file_name() {
        let name = parse("José Núñez, Jr._123_assignsubmission_file_my_camera.rs").unwrap();
        assert_eq!((name.who, name.participant), ("José Núñez, Jr.", "123"));
        assert_eq!((name.kind, name.file), ("file", "my_camera.rs"));
        let folder = parse("Participant_7_assignsubmission_file").unwrap();
        assert_eq!(
            (folder.who, folder.participant, folder.file),
            ("Participant", "7", "")
        );
        assert_eq!(parse("Jane Doe_assignsubmission_file_"), None);
    }
}
