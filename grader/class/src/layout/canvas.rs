//! Canvas's "Download submissions": a folder of files with names such as
//! `doejane_LATE_7001_9001_camera.rs`. A name consists of the student's sortable name without
//! punctuation, `LATE` if the file is late, the user id, the attachment id, and the student's file
//! name. Canvas appends `-1`, `-2`, … to the name of a file that is handed in again.
//!
//! The student's name and the file's may contain numbers as well. A name that can be read in two ways
//! is nobody's, unless a list has the name and the number of one of them.

use std::collections::{BTreeMap, BTreeSet};

use grader::handed_out::HandedOut;

use super::{LayoutContents, unmatched_path};
use crate::entry::{Entry, Person, Source};
use crate::listing::Node;
use crate::names::is_number;
use crate::roster::Member;

/// The reason for not grading a user who submitted text or a link, but no files.
const TEXT_ONLY: &str = "text or a link was handed in, but no file";
/// The reason for not grading text or a link from a user who also submitted files.
const TEXT_BESIDE_FILES: &str = "text or a link; the files handed in with it are graded";
/// The reason for not grading users with one number and different names.
const SHARED_NUMBER: &str = "another file has the same user number with another name: rename it, or \
    put the files of each student into a folder of their own";
/// The reason for not grading two files of one name, which Canvas never has.
const REPEATED_FILE: &str = "two of its files have the same name: remove the one that does not count, \
    or put the files of each student into a folder of their own";

/// The parts of a file name in Canvas's download.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CanvasName<'a> {
    who: String,
    late: bool,
    user: &'a str,
    attachment: u64,
    file: String,
}

impl<'a> CanvasName<'a> {
    /// Returns the name whose user is this part, if the part can be a user.
    fn new(parts: &[&'a str], user: usize, attachment: u64, file: String) -> Option<Self> {
        let (who, late) = split_late(&parts[..user])?;
        let user = parts[user];
        (is_number(user) || who == "anon").then_some(CanvasName {
            who,
            late,
            user,
            attachment,
            file,
        })
    }

    /// Returns the number and the name, which identify the user.
    fn key(&self) -> (&'a str, String) {
        (self.user, self.who.clone())
    }

    /// Returns whether a list has this number with a name like this one.
    fn is_listed(&self, known: &[Member]) -> bool {
        let person = self.person();
        known
            .iter()
            .any(|member| person.has_number(&member.person.number, &member.person.name))
    }

    fn person(&self) -> Person {
        Person {
            name: match self.who.as_str() {
                "anon" => format!("anon {}", self.user),
                who => who.to_owned(),
            },
            number: self.user.to_owned(),
            // Canvas writes names in lower case, without spaces.
            is_named_by_file: true,
            ..Person::default()
        }
    }
}

/// Returns the ways in which the name of a submitted file can be read.
fn readings(name: &str) -> Vec<CanvasName<'_>> {
    let parts: Vec<&str> = name.split('_').collect();
    let read = |index: usize| {
        let attachment = parts[index + 1];
        let number = is_number(attachment).then(|| attachment.parse().ok());
        CanvasName::new(&parts, index, number??, parts[index + 2..].join("_"))
    };
    let mut readings: Vec<CanvasName> = (1..parts.len().saturating_sub(2))
        .filter_map(read)
        .collect();
    // Canvas leaves out other names in an anonymous download.
    if readings.first().is_some_and(|name| name.who == "anon") {
        readings.truncate(1);
    }
    readings
}

/// Returns whether a file name is in the format of Canvas's download.
pub(super) fn is_name(name: &str) -> bool {
    !readings(name).is_empty() || parse_text(name).is_some()
}

/// Returns whether the files can be a download of Canvas, and not other files whose names have two
/// numbers, such as a date. In these, the same number or name is where Canvas has the students', or
/// two files have one attachment.
pub(super) fn is_download(root: &Node, known: &[Member]) -> bool {
    let names = root.children().iter();
    let names = names.filter_map(|node| Some((node, readings(&node.name).into_iter().next()?)));
    let names: Vec<(&Node, CanvasName)> = names.collect();
    if names.iter().any(|(_, name)| name.is_listed(known)) {
        return true;
    }
    let count = |of: fn(&CanvasName) -> String| {
        let texts: BTreeSet<String> = names.iter().map(|(_, name)| of(name)).collect();
        texts.len()
    };
    let users = count(|name| format!("{}_{}", name.who, name.user));
    let whos = count(|name| name.who.clone());
    let attachments = count(|name| format!("{}_{}_{}", name.who, name.user, name.attachment));
    let archives = names.iter().filter(|(node, _)| node.is_archive()).count();
    let is_anonymous = names.iter().all(|(_, name)| name.who == "anon");
    let is_of_one = (users == 1 && archives > 1) || (users > 1 && whos == 1 && !is_anonymous);
    attachments == names.len() && !is_of_one
}

/// Parses the name of a submitted text or link, such as `doejane_7001_text.html` or `…_link.html`;
/// returns `None` for other names.
fn parse_text(name: &str) -> Option<CanvasName<'_>> {
    let parts: Vec<&str> = name.split('_').collect();
    let index = parts.len().checked_sub(2).filter(|index| *index > 0)?;
    let file = parts[index + 1];
    let name = CanvasName::new(&parts, index, 0, file.to_owned());
    name.filter(|_| ["text.html", "link.html"].contains(&file))
}

/// Splits off `LATE`, which is after the user's name, but before `anon`. Returns the name, and whether
/// the file is late; `None` if no letter is left, as in a date, or if there is a number in the midst,
/// where Canvas removes it.
fn split_late(parts: &[&str]) -> Option<(String, bool)> {
    let (late, names) = match parts {
        ["LATE", names @ ..] if *names == ["anon"] => (true, names),
        [names @ .., "LATE"] if !names.is_empty() => (true, names),
        names => (false, names),
    };
    let inner = names
        .get(1..names.len().saturating_sub(1))
        .unwrap_or_default();
    let who = names.join("_");
    let is_name = who.chars().any(char::is_alphabetic) && !inner.iter().any(|part| is_number(part));
    is_name.then_some((who, late))
}

pub(super) fn read(root: &Node, handed_out: &HandedOut, known: &[Member]) -> LayoutContents {
    let mut users: BTreeMap<(&str, String), Vec<(CanvasName, &Node)>> = BTreeMap::new();
    let mut texts = Vec::new();
    let mut others = Vec::new();
    let mut entries = Vec::new();
    for node in root.children() {
        let mut ways = readings(&node.name);
        if ways.len() > 1 && ways.iter().filter(|name| name.is_listed(known)).count() == 1 {
            ways.retain(|name| name.is_listed(known));
        }
        match (ways.as_slice(), parse_text(&node.name)) {
            ([name], _) if !node.is_folder() => {
                let files = users.entry(name.key()).or_default();
                files.push((name.clone(), node));
            }
            ([_, _, ..], _) if !node.is_folder() => entries.push(ambiguous(&ways, node)),
            (_, Some(name)) => texts.push((name, node)),
            (_, None) => {
                others.push(unmatched_path(node, "its name is not in Canvas's format"));
            }
        }
    }
    let mut of_texts: BTreeMap<(&str, String), (CanvasName, &Node)> = BTreeMap::new();
    for (name, node) in texts {
        if users.contains_key(&name.key()) {
            others.push(unmatched_path(node, TEXT_BESIDE_FILES));
        } else if let Some((_, other)) = of_texts.insert(name.key(), (name, node)) {
            others.push(unmatched_path(other, TEXT_ONLY));
        }
    }
    for ((user, who), files) in &users {
        let mut entry = entry_of_files(files.clone(), handed_out);
        if users
            .keys()
            .any(|other| other.0 == *user && other.1 != *who)
        {
            entry.source = Source::Missing(SHARED_NUMBER.to_owned());
        }
        entries.push(entry);
    }
    entries.extend(of_texts.into_values().map(|(name, node)| {
        let source = Source::Missing(TEXT_ONLY.to_owned());
        entry(&name, name.late, &node.name, source)
    }));
    (entries, others)
}

/// Returns the entry of a file whose name can be read in several ways.
fn ambiguous(ways: &[CanvasName], node: &Node) -> Entry {
    let users = ways
        .iter()
        .map(|name| format!("{} of {}", name.user, name.who));
    let users: Vec<String> = users.collect();
    let why = format!(
        "its name can be read with the user number {}: pass a gradebook that has one of them with \
         --canvas, or rename the file",
        users.join(" or ")
    );
    let person = Person::named_by_file(&node.name);
    let mut entry = Entry::new(&node.name, person, &node.name, Source::Missing(why));
    entry.info.late = ways.iter().any(|name| name.late);
    entry
}

/// Returns the entry for all files of one user.
fn entry_of_files(mut files: Vec<(CanvasName, &Node)>, handed_out: &HandedOut) -> Entry {
    files.sort_by_key(|(name, _)| name.attachment);
    let (last, newest) = files.last().expect("every user has a file");
    // Of the archives that were handed in under one name, the newest counts. Files that were handed in
    // again come later in the list.
    let is_replaced = |index: usize| {
        let (name, node) = &files[index];
        let base = without_number(&name.file);
        let later = files[index + 1..].iter();
        let mut later = later.filter(|(_, node)| node.is_archive());
        node.is_archive() && later.any(|(name, _)| without_number(&name.file) == base)
    };
    let counting = (0..files.len()).filter(|index| !is_replaced(*index));
    let counting = counting.map(|index| {
        let (name, node) = &files[index];
        (original_name(&name.file, handed_out), node.path.clone())
    });
    let names: BTreeSet<&str> = files.iter().map(|(name, _)| name.file.as_str()).collect();
    let source = if names.len() < files.len() {
        Source::Missing(REPEATED_FILE.to_owned())
    } else {
        Source::Files(counting.collect())
    };
    let from = match files.len() {
        1 => newest.name.clone(),
        count => format!("{} and {} more", newest.name, count - 1),
    };
    // Canvas shows what is handed back under the name of the attachment, and takes the first two
    // numbers for its own.
    let archive = files.iter().rfind(|(_, node)| node.is_archive());
    let (name, attachment) = archive.unwrap_or(files.last().expect("every user has a file"));
    let is_zip = attachment.name.to_lowercase().ends_with(".zip");
    let end = if is_zip { "" } else { ".html" };
    let is_first = readings(&attachment.name).first() == Some(name);
    let mut entry = entry(last, files.iter().any(|(name, _)| name.late), &from, source);
    entry.info.hand_back_as = is_first.then(|| format!("{}{end}", attachment.name));
    entry
}

fn entry(name: &CanvasName, late: bool, from: &str, source: Source) -> Entry {
    let id = format!("{}_{}", name.who, name.user);
    let mut entry = Entry::new(id, name.person(), from, source);
    entry.info.late = late;
    entry.info.marks_late = true;
    entry
}

/// Removes the number that Canvas appends to the name of a file that is handed in again.
fn without_number(name: &str) -> String {
    let original = || {
        let (stem, end) = name.split_once('.')?;
        let (stem, number) = stem.rsplit_once('-')?;
        is_number(number).then(|| format!("{stem}.{end}"))
    };
    original().unwrap_or_else(|| name.to_owned())
}

/// Returns `camera.rs` for `camera-2.rs`. Changes only the names of task files, since other names may
/// end in a number of their own.
fn original_name(name: &str, handed_out: &HandedOut) -> String {
    let original = without_number(name);
    match handed_out.task_file(&original) {
        Some(_) => original,
        None => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use grader::handed_out::RAYS;

    use super::*;

    #[test]
    fn parses_user_lateness_and_file_name() {
        let parse = |name| match readings(name).as_slice() {
            [only] => only.clone(),
            several => panic!("{several:?}"),
        };
        let name = parse("doejane_LATE_7001_9001_my_work-1.zip");
        assert_eq!((name.who.as_str(), name.user), ("doejane", "7001"));
        assert!(name.late);
        assert_eq!(
            (name.attachment, name.file.as_str()),
            (9001, "my_work-1.zip")
        );
        assert_eq!(parse("anon_xK3f9_9001_hw.zip").user, "xK3f9");
        let late = parse("LATE_anon_77_9001_2_hw.zip");
        assert_eq!(
            (late.who.as_str(), late.user, late.late),
            ("anon", "77", true)
        );
        for none in [
            "doejane_7001_text.html",
            "7001_9001_hw.zip",
            "2026_11_21_jdoe.zip",
        ] {
            assert_eq!(readings(none), [], "{none}");
        }
    }

    #[test]
    fn removes_canvas_numbers_from_task_file_names_only() {
        assert_eq!(original_name("camera-12.rs", &RAYS), "camera.rs");
        assert_eq!(original_name("camera-final.rs", &RAYS), "camera-final.rs");
        assert_eq!(original_name("scene-2.rs", &RAYS), "scene-2.rs");
    }
}
