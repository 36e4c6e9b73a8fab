//! Canvas's "Download submissions": files side by side, named
//! `doejane_LATE_7001_9001_camera.rs`: the sortable name without signs, whether it is late, the
//! user, the attachment, and the name that the student gave it, to which Canvas adds `-1`, `-2` when it is
//! handed in again.

use std::collections::BTreeMap;

use grader::given::TASK_FILES;

use super::{Entries, unmatched};
use crate::entry::{About, Entry, Person, Source};
use crate::listing::Node;

/// What a file's name tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name<'a> {
    who: String,
    late: bool,
    user: &'a str,
    attachment: u64,
    file: String,
}

/// None if it is not such a name.
pub(super) fn parse(name: &str) -> Option<Name<'_>> {
    let parts: Vec<&str> = name.split('_').collect();
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    // Without names, an id of letters and digits stands in the user's place.
    let is_user = |place: usize| is_number(parts[place]) || parts[place - 1] == "anon";
    let place = (1..parts.len().saturating_sub(2))
        .find(|place| is_user(*place) && is_number(parts[place + 1]))?;
    let (late, names) = match &parts[..place] {
        [names @ .., "LATE"] if !names.is_empty() => (true, names),
        names => (false, names),
    };
    Some(Name {
        who: names.join("_"),
        late,
        user: parts[place],
        attachment: parts[place + 1].parse().ok()?,
        file: parts[place + 2..].join("_"),
    })
}

pub(super) fn read(root: &Node) -> Entries {
    let mut users: BTreeMap<&str, Vec<(Name, &Node)>> = BTreeMap::new();
    let mut others = Vec::new();
    for node in root.nodes() {
        match parse(&node.name) {
            Some(name) if !node.is_folder() => {
                users.entry(name.user).or_default().push((name, node));
            }
            Some(_) | None if node.name.ends_with(".html") => {
                others.push(unmatched(
                    node,
                    "a text or a link was handed in, and no file",
                ));
            }
            Some(_) | None => others.push(unmatched(node, "its name is not one of Canvas's")),
        }
    }
    (users.into_values().map(entry).collect(), others)
}

/// All of one user's files.
fn entry(mut files: Vec<(Name, &Node)>) -> Entry {
    files.sort_by_key(|(name, _)| name.attachment);
    let (last, newest) = files.last().expect("a user is known by a file");
    let archive = files.iter().rfind(|(_, node)| node.is_archive());
    let source = match archive {
        Some((_, archive)) => Source::Path(archive.path.clone()),
        // Of a file that was handed in again the newest counts: it is taken last.
        None => Source::Files(
            files
                .iter()
                .map(|(name, node)| (first_name(&name.file), node.path.clone()))
                .collect(),
        ),
    };
    Entry {
        id: format!("{}_{}", last.who, last.user),
        about: About {
            people: vec![Person {
                name: match last.who.as_str() {
                    "anon" => format!("anon {}", last.user),
                    who => who.to_owned(),
                },
                number: last.user.to_owned(),
                ..Person::default()
            }],
            late: files.iter().any(|(name, _)| name.late),
            submitted: None,
            from: match (archive, files.len()) {
                (Some((_, archive)), _) => archive.name.clone(),
                (None, 1) => newest.name.clone(),
                (None, count) => format!("{} and {} more", newest.name, count - 1),
            },
        },
        source,
    }
}

/// `camera.rs` of `camera-2.rs`: only of the five, whose names are known.
fn first_name(name: &str) -> String {
    let original = |file: &str| -> Option<String> {
        let (stem, end) = file.rsplit_once('.')?;
        let (stem, number) = stem.rsplit_once('-')?;
        let is_number = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
        is_number.then(|| format!("{stem}.{end}"))
    };
    original(name)
        .filter(|name| TASK_FILES.iter().any(|file| file.name == name))
        .unwrap_or_else(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_tells_who_when_and_what() {
        let name = parse("doejane_LATE_7001_9001_my_work-1.zip").unwrap();
        assert_eq!((name.who.as_str(), name.user), ("doejane", "7001"));
        assert!(name.late);
        assert_eq!(
            (name.attachment, name.file.as_str()),
            (9001, "my_work-1.zip")
        );
        assert_eq!(parse("anon_xK3f9_9001_hw.zip").unwrap().user, "xK3f9");
        assert_eq!(parse("doejane_7001_text.html"), None);
        assert_eq!(parse("7001_9001_hw.zip"), None);
    }

    #[test]
    fn numbers_of_canvas_are_taken_from_the_names_that_we_know() {
        assert_eq!(first_name("camera-12.rs"), "camera.rs");
        assert_eq!(first_name("camera-final.rs"), "camera-final.rs");
        assert_eq!(first_name("scene-2.rs"), "scene-2.rs");
    }
}
