//! Moodle's "Download all submissions": `Jane Doe_123_assignsubmission_file_`, a folder or the
//! beginning of a file's name. The number is the participant's, which the worksheet has as well.

use std::collections::BTreeMap;

use super::{Entries, unmatched};
use crate::entry::{About, Entry, Person, Source};
use crate::listing::Node;

const MARK: &str = "_assignsubmission_";

/// What a name tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name<'a> {
    /// With the group in front, where there are groups.
    who: &'a str,
    participant: &'a str,
    /// `file`, or another way of handing in.
    way: &'a str,
    /// The file, in downloads without folders.
    file: &'a str,
}

/// None if it is not such a name.
pub(super) fn parse(name: &str) -> Option<Name<'_>> {
    let (head, tail) = name.split_once(MARK)?;
    let (way, file) = tail.split_once('_').unwrap_or((tail, ""));
    let (who, participant) = head.rsplit_once('_')?;
    let is_number = !participant.is_empty() && participant.bytes().all(|b| b.is_ascii_digit());
    is_number.then_some(Name {
        who,
        participant,
        way,
        file,
    })
}

pub(super) fn read(root: &Node) -> Entries {
    let mut people: BTreeMap<&str, Vec<(Name, &Node)>> = BTreeMap::new();
    let mut others = Vec::new();
    for node in root.nodes() {
        match parse(&node.name) {
            Some(name) if name.way == "file" => {
                people
                    .entry(name.participant)
                    .or_default()
                    .push((name, node));
            }
            Some(_) => others.push(unmatched(node, "a text was handed in, and no file")),
            None => others.push(unmatched(node, "its name is not one of Moodle's")),
        }
    }
    (people.into_values().map(entry).collect(), others)
}

fn entry(found: Vec<(Name, &Node)>) -> Entry {
    let (name, first) = &found[0];
    let whole = found
        .iter()
        .find(|(_, node)| node.is_folder() || node.is_archive());
    let source = match whole {
        Some((_, node)) => Source::Path(node.path.clone()),
        None => Source::Files(
            found
                .iter()
                .map(|(name, node)| (name.file.to_owned(), node.path.clone()))
                .collect(),
        ),
    };
    Entry {
        id: format!("{}_{}", name.who, name.participant),
        about: About {
            people: vec![Person {
                // Where marking is blind, the number is all that there is.
                name: match name.who {
                    "Participant" => format!("Participant {}", name.participant),
                    who => who.to_owned(),
                },
                number: name.participant.to_owned(),
                ..Person::default()
            }],
            from: whole.map_or(first, |(_, node)| node).name.clone(),
            ..About::default()
        },
        source,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_tells_who_and_what() {
        let name = parse("José Núñez, Jr._123_assignsubmission_file_my_camera.rs").unwrap();
        assert_eq!((name.who, name.participant), ("José Núñez, Jr.", "123"));
        assert_eq!((name.way, name.file), ("file", "my_camera.rs"));
        let folder = parse("Participant_7_assignsubmission_file").unwrap();
        assert_eq!(
            (folder.who, folder.participant, folder.file),
            ("Participant", "7", "")
        );
        assert_eq!(parse("Jane Doe_assignsubmission_file_"), None);
    }
}
