//! Canvas's "Download submissions": a folder of files with names such as
//! `doejane_LATE_7001_9001_camera.rs`. A name consists of the student's sortable name without
//! punctuation, `LATE` if the file is late, the user id, the attachment id, and the student's file
//! name. Canvas appends `-1`, `-2`, … to the name of a file that is handed in again.

use std::collections::BTreeMap;

use grader::handed_out::HandedOut;

use super::{LayoutContents, unmatched_path};
use crate::entry::{Entry, EntryInfo, Person, Source};
use crate::listing::Node;

/// The reason for not grading a user who submitted text or a link, but no files.
const TEXT_ONLY: &str = "text or a link was handed in, but no file";
/// The reason for not grading text or a link from a user who also submitted files.
const TEXT_BESIDE_FILES: &str = "text or a link; the files handed in with it are graded";

/// The parts of a file name in Canvas's download.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CanvasName<'a> {
    who: String,
    late: bool,
    user: &'a str,
    attachment: u64,
    file: String,
}

/// Parses the name of a submitted file; returns `None` for other names.
fn parse(name: &str) -> Option<CanvasName<'_>> {
    let parts: Vec<&str> = name.split('_').collect();
    let index = (1..parts.len().saturating_sub(2))
        .find(|index| is_user(&parts, *index) && is_number(parts[index + 1]))?;
    let (who, late) = split_late(&parts[..index]);
    Some(CanvasName {
        who,
        late,
        user: parts[index],
        attachment: parts[index + 1].parse().ok()?,
        file: parts[index + 2..].join("_"),
    })
}

/// Returns whether a file name is in the format of Canvas's download.
pub(super) fn is_name(name: &str) -> bool {
    parse(name).is_some() || parse_text(name).is_some()
}

/// Parses the name of a submitted text or link, such as `doejane_7001_text.html` or `…_link.html`;
/// returns `None` for other names.
fn parse_text(name: &str) -> Option<CanvasName<'_>> {
    let parts: Vec<&str> = name.split('_').collect();
    let index = parts.len().checked_sub(2)?;
    let is_text = ["text.html", "link.html"].contains(&parts[index + 1]);
    let (who, late) = split_late(&parts[..index]);
    (is_text && index > 0 && is_user(&parts, index)).then(|| CanvasName {
        who,
        late,
        user: parts[index],
        attachment: 0,
        file: parts[index + 1].to_owned(),
    })
}

/// Returns whether a part of the name is a user id. In anonymous downloads, the part before the id
/// is `anon`, and the id may contain letters.
fn is_user(parts: &[&str], index: usize) -> bool {
    is_number(parts[index]) || parts[index - 1] == "anon"
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

/// Splits off `LATE`: returns the user's name, and whether the file is late.
fn split_late(parts: &[&str]) -> (String, bool) {
    let (late, names) = match parts {
        [names @ .., "LATE"] if !names.is_empty() => (true, names),
        // Canvas writes `LATE` before `anon`, but after a name.
        ["LATE", names @ ..] if names == ["anon"] => (true, names),
        names => (false, names),
    };
    (names.join("_"), late)
}

pub(super) fn read(root: &Node, handed_out: &HandedOut) -> LayoutContents {
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
                others.push(unmatched_path(node, "its name is not in Canvas's format"));
            }
        }
    }
    let mut of_texts: BTreeMap<&str, (CanvasName, &Node)> = BTreeMap::new();
    for (name, node) in texts {
        if users.contains_key(name.user) {
            others.push(unmatched_path(node, TEXT_BESIDE_FILES))
        } else {
            _ = of_texts.insert(name.user, (name, node))
        }
    }
    let of_texts = of_texts.into_values();
    let of_texts = of_texts.map(|(name, node)| {
        let source = Source::Missing(TEXT_ONLY.to_owned());
        entry(&name, name.late, node.name.clone(), source)
    });
    let entries = users
        .into_values()
        .map(|files| entry_of_files(files, handed_out))
        .chain(of_texts);
    (entries.collect(), others)
}

/// Returns the entry for all files of one user.
fn entry_of_files(mut files: Vec<(CanvasName, &Node)>, handed_out: &HandedOut) -> Entry {
    files.sort_by_key(|(name, _)| name.attachment);
    let (last, newest) = files.last().expect("every user has a file");
    // Of several archives, the newest counts. Files that were handed in again come later in the list.
    let archive = files.iter().rfind(|(_, node)| node.is_archive());
    let counts = |(_, node): &&(CanvasName, &Node)| {
        !node.is_archive() || archive.is_some_and(|(_, newest)| newest.path == node.path)
    };
    let name_and_path = |(name, node): &(CanvasName, &Node)| {
        (original_name(&name.file, handed_out), node.path.clone())
    };
    let source = Source::Files(files.iter().filter(counts).map(name_and_path).collect());
    let from = match files.len() {
        1 => newest.name.clone(),
        count => format!("{} and {} more", newest.name, count - 1),
    };
    // Canvas shows what is handed back under the name of the attachment.
    let attachment = archive.map_or(*newest, |(_, node)| *node);
    let is_zip = attachment.name.to_lowercase().ends_with(".zip");
    let end = if is_zip { "" } else { ".html" };
    let mut entry = entry(last, files.iter().any(|(name, _)| name.late), from, source);
    entry.info.hand_back_as = Some(format!("{}{end}", attachment.name));
    entry
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
                // Canvas writes names in lower case, without spaces.
                is_named_by_file: true,
                ..Person::default()
            }],
            late,
            marks_late: true,
            from,
            ..EntryInfo::default()
        },
        source,
    }
}

/// Removes the number that Canvas appends: returns `camera.rs` for `camera-2.rs`. Changes only the
/// names of task files, since other names may end in a number of their own.
fn original_name(name: &str, handed_out: &HandedOut) -> String {
    let original = |file: &str| -> Option<String> {
        let (stem, end) = file.rsplit_once('.')?;
        let (stem, number) = stem.rsplit_once('-')?;
        let is_number = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
        is_number.then(|| format!("{stem}.{end}"))
    };
    original(name)
        .filter(|name| handed_out.task_file(name).is_some())
        .unwrap_or_else(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use grader::handed_out::RAYS;

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
        for (anonymous, late) in [
            ("anon_xK3f9_9001_hw.zip", false),
            ("LATE_anon_xK3f9_9001_hw.zip", true),
        ] {
            let name = parse(anonymous).unwrap();
            assert_eq!(
                (name.who.as_str(), name.user, name.late),
                ("anon", "xK3f9", late)
            );
        }
        assert_eq!(parse("doejane_7001_text.html"), None);
        assert_eq!(parse("7001_9001_hw.zip"), None);
    }

    #[test]
    fn removes_canvas_numbers_from_task_file_names_only() {
        assert_eq!(original_name("camera-12.rs", &RAYS), "camera.rs");
        assert_eq!(original_name("camera-final.rs", &RAYS), "camera-final.rs");
        assert_eq!(original_name("scene-2.rs", &RAYS), "scene-2.rs");
    }
}
