//! Canvas's "Download submissions": files side by side, named
//! `doejane_LATE_7001_9001_camera.rs`: the sortable name without signs, whether it is late, the
//! user, the attachment, and the name that the student gave it, to which Canvas adds `-1`, `-2` when it is
//! handed in again.

use std::collections::BTreeMap;

use super::{LayoutContents, is_task_file, unmatched_path};
use crate::entry::{Entry, EntryInfo, Person, Source};
use crate::listing::Node;

/// Of somebody whose text or link is all there is.
const TEXT_ONLY: &str = "a text or a link was handed in, and no file";
/// Of a text of somebody who handed in files as well.
const TEXT_BESIDE_FILES: &str = "a text or a link, beside files: those are graded";

/// What a file's name tells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CanvasName<'a> {
    who: String,
    late: bool,
    user: &'a str,
    attachment: u64,
    file: String,
}

/// None if it is not such a name.
fn parse(name: &str) -> Option<CanvasName<'_>> {
    let parts: Vec<&str> = name.split('_').collect();
    let place = (1..parts.len().saturating_sub(2))
        .find(|place| is_user(&parts, *place) && is_number(parts[place + 1]))?;
    let (who, late) = split_late(&parts[..place]);
    Some(CanvasName {
        who,
        late,
        user: parts[place],
        attachment: parts[place + 1].parse().ok()?,
        file: parts[place + 2..].join("_"),
    })
}

/// Whether a name is one of Canvas's.
pub(super) fn is_name(name: &str) -> bool {
    parse(name).is_some() || parse_text(name).is_some()
}

/// Of `doejane_7001_text.html`, and of `…_link.html`. None if it is not such a name.
fn parse_text(name: &str) -> Option<CanvasName<'_>> {
    let parts: Vec<&str> = name.split('_').collect();
    let place = parts.len().checked_sub(2)?;
    let is_text = ["text.html", "link.html"].contains(&parts[place + 1]);
    let (who, late) = split_late(&parts[..place]);
    (is_text && place > 0 && is_user(&parts, place)).then(|| CanvasName {
        who,
        late,
        user: parts[place],
        attachment: 0,
        file: parts[place + 1].to_owned(),
    })
}

/// Without names, an id of letters and digits stands in the user's place.
fn is_user(parts: &[&str], place: usize) -> bool {
    is_number(parts[place]) || parts[place - 1] == "anon"
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

/// The name, and whether it is late.
fn split_late(parts: &[&str]) -> (String, bool) {
    let (late, names) = match parts {
        [names @ .., "LATE"] if !names.is_empty() => (true, names),
        names => (false, names),
    };
    (names.join("_"), late)
}

pub(super) fn read(root: &Node) -> LayoutContents {
    let mut users: BTreeMap<&str, Vec<(CanvasName, &Node)>> = BTreeMap::new();
    let mut texts = Vec::new();
    let mut others = Vec::new();
    for node in root.children() {
        match (parse(&node.name), parse_text(&node.name)) {
            (Some(name), _) if !node.is_folder() => {
                users.entry(name.user).or_default().push((name, node));
            }
            (_, Some(name)) => texts.push((name, node)),
            (Some(_) | None, None) => {
                others.push(unmatched_path(node, "its name is not one of Canvas's"));
            }
        }
    }
    let mut of_texts: BTreeMap<&str, (CanvasName, &Node)> = BTreeMap::new();
    for (name, node) in texts {
        match users.contains_key(name.user) {
            true => others.push(unmatched_path(node, TEXT_BESIDE_FILES)),
            false => _ = of_texts.insert(name.user, (name, node)),
        }
    }
    let of_texts = of_texts.into_values();
    let of_texts = of_texts.map(|(name, node)| {
        let source = Source::Missing(TEXT_ONLY.to_owned());
        entry(&name, name.late, node.name.clone(), source)
    });
    let entries = users.into_values().map(entry_of_files).chain(of_texts);
    (entries.collect(), others)
}

/// All of one user's files.
fn entry_of_files(mut files: Vec<(CanvasName, &Node)>) -> Entry {
    files.sort_by_key(|(name, _)| name.attachment);
    let (last, newest) = files.last().expect("a user is known by a file");
    let is_one = |(name, _): &(CanvasName, &Node)| is_task_file(&original_name(&name.file));
    let archive = files.iter().rfind(|(_, node)| node.is_archive());
    // What lies open counts, as it does in a folder.
    let archive = archive.filter(|_| !files.iter().any(is_one));
    let source = match archive {
        Some((_, archive)) => Source::Path(archive.path.clone()),
        // Of a file that was handed in again the newest counts: it is taken last.
        None => Source::Files(
            files
                .iter()
                .map(|(name, node)| (original_name(&name.file), node.path.clone()))
                .collect(),
        ),
    };
    let from = match (archive, files.len()) {
        (Some((_, archive)), _) => archive.name.clone(),
        (None, 1) => newest.name.clone(),
        (None, count) => format!("{} and {} more", newest.name, count - 1),
    };
    entry(last, files.iter().any(|(name, _)| name.late), from, source)
}

fn entry(name: &CanvasName, late: bool, from: String, source: Source) -> Entry {
    Entry {
        id: format!("{}_{}", name.who, name.user),
        info: EntryInfo {
            people: vec![Person {
                name: match name.who.as_str() {
                    "anon" => format!("anon {}", name.user),
                    who => who.to_owned(),
                },
                number: name.user.to_owned(),
                ..Person::default()
            }],
            late,
            submitted: None,
            from,
        },
        source,
    }
}

/// `camera.rs` of `camera-2.rs`: only of the five, whose names are known.
fn original_name(name: &str) -> String {
    let original = |file: &str| -> Option<String> {
        let (stem, end) = file.rsplit_once('.')?;
        let (stem, number) = stem.rsplit_once('-')?;
        let is_number = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
        is_number.then(|| format!("{stem}.{end}"))
    };
    original(name)
        .filter(|name| is_task_file(name))
        .unwrap_or_else(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_user_lateness_and_file_name() {
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
    fn removes_canvas_numbers_from_task_file_names_only() {
        assert_eq!(original_name("camera-12.rs"), "camera.rs");
        assert_eq!(original_name("camera-final.rs"), "camera-final.rs");
        assert_eq!(original_name("scene-2.rs"), "scene-2.rs");
    }
}
