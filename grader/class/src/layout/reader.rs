//! Reads a class by its [`Platform`]: finds the submissions by the names of files and folders, and their
//! people and times by these names or in files that the platform has written.

use std::collections::{BTreeMap, BTreeSet};

use grader::files;
use grader::handed_out::HandedOut;
use judging::sanitize::sanitize_line;

use super::gradescope::read_metadata;
use super::mixture::is_section;
use super::platforms::{HandBackName, Platform, Record, SUBMISSIONS_SUFFIX};
use super::template::{Parts, read_members, readings};
use super::times::written_time;
use super::{Layout, LayoutChoice, LayoutContents, UnmatchedPath};
use crate::entry::{Entry, Person, Source};
use crate::error::Error;
use crate::listing::Node;
use crate::names::is_number;
use crate::roster::Member;

/// The reason for not grading users with the same number but different names.
const SHARED_NUMBER: &str = "another file has the same user number with another name: rename it, or \
    put the files of each student into a folder of their own";
/// The reason for not grading two files with the same name, which Canvas never exports.
const REPEATED_FILE: &str = "two of its files have the same name: remove the one that does not count, \
    or put the files of each student into a folder of their own";
/// The reason for not grading two downloads that were unpacked into one folder.
const SEVERAL: &str = "it is in several folders of this name: keep the one that counts";
/// The maximum length of a list of titles in a message, in characters.
const MAX_CHARS: usize = 400;
/// The fields that differ between the files of one submission.
const OF_FILES: [&str; 4] = ["file", "attachment", "late", "kind"];
/// Sakai's folder for the files that a student handed in. Folders next to it contain feedback.
const SAKAI_ATTACHMENTS: &str = "Submission attachment(s)";
/// Sakai's file with the submission time.
pub const SAKAI_TIME: &str = "timestamp.txt";
/// Sakai's file with the members of a group.
pub const SAKAI_MEMBERS: &str = "members.txt";

/// The people of a submission and its time, as recorded by the platform. Unknown ones are empty.
#[derive(Debug, Default)]
pub(super) struct SubmissionRecord {
    pub people: Vec<Person>,
    pub time: Option<String>,
}

/// A file or folder whose name belongs to a submission.
struct Found<'a> {
    parts: Parts<'a>,
    node: &'a Node,
    /// The path relative to the class's folder.
    path: String,
    is_text: bool,
}

/// Reads the classes of a platform.
pub(super) struct Reader<'a> {
    pub platform: &'static Platform,
    pub handed_out: &'a HandedOut,
    /// The people on lists.
    pub known: &'a [Member],
}

/// The names that were read in a class's folder.
#[derive(Default)]
struct Names<'a> {
    found: Vec<Found<'a>>,
    /// The entries of files whose names can be read in several ways.
    ambiguous: Vec<Entry>,
    unmatched: Vec<UnmatchedPath>,
}

/// Returns whether a name in the class's folder follows one of the platform's templates.
pub(super) fn is_name(platform: &Platform, name: &str) -> bool {
    let outermost = platform.outer_folders.first().copied();
    let templates = outermost.unwrap_or(platform.files).iter();
    let mut templates = templates.chain(platform.texts);
    templates.any(|template| !readings(template, name).is_empty())
}

impl Reader<'_> {
    /// Returns whether the files can be a download from Canvas, rather than other files with two
    /// numbers in their names, such as a date. Those repeat a number or name where Canvas gives the
    /// students', or contain the same attachment twice.
    pub fn is_canvas_download(&self, root: &Node) -> bool {
        let nodes = root.children().iter();
        let names = nodes.map(|node| (node, first_readings(self.platform.files, &node.name)));
        let names: Vec<_> = names.filter(|(_, ways)| !ways.is_empty()).collect();
        if names.iter().any(|(_, ways)| self.is_listed(&ways[0])) {
            return true;
        }
        let count = |templates: &[&'static str]| {
            let texts = names.iter().map(|(_, ways)| ways[0].fill_first(templates));
            texts.collect::<BTreeSet<String>>().len()
        };
        let users = count(self.platform.ids);
        let whos = count(&["{canvas_name}", "anon"]);
        let named = "{canvas_name}_{number}_{attachment}";
        let attachments = count(&[named, "anon_{anonymous}_{attachment}"]);
        let archives = names.iter().filter(|(node, _)| node.is_archive()).count();
        let is_anonymous = names.iter().all(|(_, ways)| ways[0].has("anonymous"));
        let is_of_one = (users == 1 && archives > 1) || (users > 1 && whos == 1 && !is_anonymous);
        attachments == names.len() && !is_of_one
    }

    /// Returns the entries of a class, and the paths that don't belong to any. `metadata` is the
    /// text of Gradescope's file.
    pub fn read(
        &self,
        root: &Node,
        metadata: Option<&str>,
        choice: &LayoutChoice,
    ) -> Result<LayoutContents, Error> {
        let platform = self.platform;
        let metadata = metadata.filter(|_| platform.record == Record::Metadata);
        let mut records = metadata.map(read_metadata).transpose()?.unwrap_or_default();
        let (mut names, outer) = (Names::default(), Parts::default());
        self.visit(root, platform.outer_folders, &outer, "", &mut names);
        choose_title(&mut names.found, choice)?;
        self.strip_prefix(root, &mut names.found);
        let (mut entries, mut unmatched) = (names.ambiguous, names.unmatched);
        let mut groups: BTreeMap<Parts, Vec<Found>> = BTreeMap::new();
        for found in names.found {
            let key = found.parts.without(&OF_FILES);
            groups.entry(key).or_default().push(found);
        }
        let mut names_of: BTreeMap<&str, usize> = BTreeMap::new();
        for (parts, group) in &groups {
            let has_files = group.iter().any(|found| !found.is_text);
            *names_of.entry(number(parts)).or_default() += usize::from(has_files);
        }
        for (mut parts, group) in groups {
            let (texts, files): (Vec<_>, Vec<_>) =
                group.into_iter().partition(|found| found.is_text);
            let record = match platform.record {
                Record::None => SubmissionRecord::default(),
                Record::Receipt => read_receipt(&mut parts, &texts)?,
                Record::FilesInFolder => read_files_in_folder(&parts, &files)?,
                Record::Metadata => match records.remove(parts.get("submission")) {
                    Some(record) => record,
                    None => {
                        let others = files.into_iter();
                        unmatched.extend(others.map(|found| found.unmatched(platform.unmatched)));
                        continue;
                    }
                },
            };
            let is_shared =
                platform.has_attachments() && !files.is_empty() && names_of[number(&parts)] > 1;
            let mut entry = self.entry(&parts, files, texts, &mut unmatched);
            if is_shared {
                entry.leave_to_staff(SHARED_NUMBER.to_owned());
            }
            entries.push(record.describe(entry));
        }
        for (name, record) in records {
            let source = Source::Missing("its folder is not in the export".to_owned());
            let mut entry = Entry::new(&name, Person::named_by_file(&name), &name, source);
            entry.info.needs_staff = true;
            entries.push(record.describe(entry));
        }
        Ok((entries, unmatched))
    }

    /// Reads the names in a folder. `levels` are the templates of folders between it and the
    /// submissions, `outer` the parts of the folders that it is in, and `above` their path.
    fn visit<'a>(
        &self,
        folder: &'a Node,
        levels: &[&'static [&'static str]],
        outer: &Parts<'a>,
        above: &str,
        names: &mut Names<'a>,
    ) {
        for node in folder.children() {
            let path = match above {
                "" => node.name.clone(),
                above => format!("{above}/{}", node.name),
            };
            let may_have_sections = self.platform.layout == Layout::GitLab && above.is_empty();
            if let [templates, inner @ ..] = levels {
                let own = first_readings(templates, &node.name).into_iter().next();
                match own.filter(|_| node.is_folder() && !node.is_link) {
                    Some(own) => self.visit(node, inner, &outer.join(&own), &path, names),
                    None => names
                        .unmatched
                        .push(unmatched(path, self.platform.unmatched)),
                }
            } else if may_have_sections && is_section(node, self.handed_out) {
                self.visit(node, levels, outer, &path, names);
            } else if node.is_folder() || !self.platform.own_files.contains(&path.as_str()) {
                self.add(node, outer, path, names);
            }
        }
    }

    /// Adds a file or folder at the level of the submissions.
    fn add<'a>(&self, node: &'a Node, outer: &Parts<'a>, path: String, names: &mut Names<'a>) {
        let mut ways = Vec::new();
        if (self.platform.is_submission)(node) {
            ways = first_readings(self.platform.files, &node.name);
        }
        if !self.platform.has_attachments() {
            ways.truncate(1);
        } else if ways.iter().filter(|parts| self.is_listed(parts)).count() == 1 {
            // The student's name and the file's may contain numbers as well.
            ways.retain(|parts| self.is_listed(parts));
        }
        if ways.len() > 1 {
            names.ambiguous.push(ambiguous(&ways, node));
            return;
        }
        let is_text = ways.is_empty();
        if is_text {
            ways = first_readings(self.platform.texts, &node.name);
        }
        let Some(own) = ways.first() else {
            names
                .unmatched
                .push(unmatched(path, self.platform.unmatched));
            return;
        };
        let mut parts = outer.join(own);
        if self.platform.layout == Layout::Plain && !node.is_folder() {
            // A folder with the same name is a different submission.
            parts.set("whole_name", &node.name);
            parts.set("name", strip_archive_extension(&node.name));
        }
        names.found.push(Found {
            parts,
            node,
            path,
            is_text,
        });
    }

    /// Removes the text that all names begin with, such as the assignment's title.
    fn strip_prefix(&self, root: &Node, found: &mut [Found]) {
        let Some((field, separator)) = self.platform.prefixed else {
            return;
        };
        let names = found.iter().filter(|found| !found.node.is_link);
        let names: BTreeSet<&str> = names.map(|found| found.parts.get(field)).collect();
        let assignment = root.name.strip_suffix(SUBMISSIONS_SUFFIX);
        let prefix = match assignment.filter(|_| self.platform.layout == Layout::GitHub) {
            Some(assignment) => format!("{assignment}{separator}"),
            None => common_prefix(&Vec::from_iter(names), separator).to_owned(),
        };
        for Found { parts, .. } in found {
            let whole = parts.get(field);
            parts.set("whole_name", whole);
            parts.set(field, whole.strip_prefix(&prefix).unwrap_or(whole));
        }
    }

    /// Returns whether a list has the person's number with a similar name.
    fn is_listed(&self, parts: &Parts) -> bool {
        let person = person(self.platform, parts);
        let mut members = self.known.iter().map(|member| &member.person);
        members.any(|member| person.has_number(&member.number, &member.name))
    }

    /// Returns the entry of a submission. Texts that are not graded are added to `others`.
    fn entry(
        &self,
        parts: &Parts,
        mut files: Vec<Found>,
        mut texts: Vec<Found>,
        others: &mut Vec<UnmatchedPath>,
    ) -> Entry {
        let platform = self.platform;
        files.sort_by_key(|found| found.parts.get("attachment").parse::<u64>().ok());
        let folder = files.iter().find(|found| found.node.is_folder());
        let text = texts.pop_if(|_| files.is_empty());
        let (from, source) = match (files.as_slice(), &text) {
            ([], text) => {
                let from = text.as_ref().map(|text| text.path.clone());
                let source = Source::Missing(platform.text_only.to_owned());
                (from.unwrap_or_default(), source)
            }
            ([others @ .., last], _) if platform.has_attachments() && !others.is_empty() => {
                let from = format!("{} and {} more", last.path, others.len());
                (from, self.source(&files))
            }
            ([first, ..], _) => (folder.unwrap_or(first).path.clone(), self.source(&files)),
        };
        let mut named = files.iter().chain(&text);
        let late = named.any(|found| found.parts.has("late"));
        let why = if files.is_empty() {
            Some(platform.text_only)
        } else {
            platform.text_beside_files
        };
        if let Some(why) = why {
            others.extend(texts.into_iter().map(|found| found.unmatched(why)));
        }
        let id = parts.fill_first(platform.ids);
        let mut entry = Entry::new(id, person(platform, parts), &from, source);
        // Files that were handed in lead to no reason here but their names.
        entry.info.needs_staff = !files.is_empty() && matches!(entry.source, Source::Missing(_));
        entry.info.late = late;
        entry.info.marks_late = platform.files.iter().any(|name| name.contains("{late}"));
        entry.info.attempt = parts.get("attempt").parse().ok();
        entry.info.submitted = written_time(parts.get("time"));
        entry.info.hand_back_as = match platform.hand_back {
            HandBackName::None => None,
            HandBackName::Marks(name) => Some(name.to_owned()),
            HandBackName::Attachment => attachment_name(platform, &files),
        };
        entry
    }

    /// Returns the location of a submission's files.
    fn source(&self, files: &[Found]) -> Source {
        let name = |found: &Found| found.parts.get("file").to_owned();
        match files {
            [only] if only.node.is_folder() => {
                let is_sakai = self.platform.record == Record::FilesInFolder;
                let inside = only.node.find(SAKAI_ATTACHMENTS).filter(|_| is_sakai);
                return Source::Path(inside.unwrap_or(only.node).path.clone());
            }
            [only] if name(only).is_empty() => return Source::Path(only.node.path.clone()),
            files if files.iter().any(|found| found.node.is_folder()) => {
                return Source::Missing(SEVERAL.to_owned());
            }
            _ => {}
        }
        let names: BTreeSet<String> = files.iter().map(name).collect();
        if names.len() < files.len() {
            return Source::Missing(REPEATED_FILE.to_owned());
        }
        let mut counting = Vec::new();
        for (index, found) in files.iter().enumerate() {
            // If several archives were handed in under the same name, the newest is used. Files that
            // were handed in again come later in the list.
            let base = without_number(&name(found));
            let mut later = files[index + 1..]
                .iter()
                .filter(|other| other.node.is_archive());
            let is_replaced =
                found.node.is_archive() && later.any(|other| without_number(&name(other)) == base);
            let is_renamed = self.platform.has_attachments();
            if is_renamed && is_replaced {
                continue;
            }
            // Names other than those of task files may end in their own numbers.
            let is_task_file = is_renamed && self.handed_out.task_file(&base).is_some();
            let own = if is_task_file { base } else { name(found) };
            counting.push((own, found.node.path.clone()));
        }
        Source::Files(counting)
    }
}

impl Found<'_> {
    fn unmatched(self, why: &str) -> UnmatchedPath {
        unmatched(self.path, why)
    }
}

fn unmatched(name: String, why: &str) -> UnmatchedPath {
    let why = why.to_owned();
    UnmatchedPath { name, why }
}

impl SubmissionRecord {
    /// Adds the recorded information to an entry.
    fn describe(self, mut entry: Entry) -> Entry {
        if !self.people.is_empty() {
            entry.info.people = self.people;
        }
        entry.info.submitted = self.time.or(entry.info.submitted);
        entry
    }
}

/// Keeps the submissions of one assignment. Rejects a class with several assignments if none was
/// chosen.
fn choose_title(found: &mut Vec<Found>, choice: &LayoutChoice) -> Result<(), Error> {
    let titles = found.iter().map(|found| found.parts.get("title"));
    let titles: BTreeSet<&str> = titles.filter(|title| !title.is_empty()).collect();
    let all = Vec::from_iter(titles.iter().copied()).join(", ");
    let all = sanitize_line(&all, MAX_CHARS);
    match choice.title.as_deref() {
        Some(title) if titles.contains(title) => {
            found.retain(|found| found.parts.get("title") == title);
            Ok(())
        }
        Some(title) => Err(Error::user(format!(
            "no folder of an assignment has the title {title:?}, only: {all}"
        ))),
        None if titles.len() > 1 => Err(Error::user(format!(
            "the input has several assignments ({all}): choose one with --title"
        ))),
        None => Ok(()),
    }
}

/// Reads the first line of Blackboard's text file, `Name: Jane Doe (jdoe)`, where the word before the
/// colon depends on the language. The assignment's title and the account may contain `_`, so only this
/// line shows where the account begins.
fn read_receipt(parts: &mut Parts, texts: &[Found]) -> Result<SubmissionRecord, Error> {
    let text = read_text(texts.first().map(|text| text.node))?.unwrap_or_default();
    let line = text.lines().next().and_then(|line| line.split_once(": "));
    let name = line.and_then(|(_, name)| name.trim().strip_suffix(')')?.rsplit_once(" ("));
    let whole = parts.get("whole_name");
    let is_end = |account: &str| {
        let title = whole.strip_suffix(account);
        title.is_some_and(|title| title.is_empty() || title.ends_with('_'))
    };
    let Some((name, account)) = name.filter(|(_, account)| is_end(account)) else {
        return Ok(SubmissionRecord::default());
    };
    parts.set("account", &whole[whole.len() - account.len()..]);
    let person = Person {
        login: account.to_owned(),
        ..Person::named(name.trim())
    };
    Ok(SubmissionRecord {
        people: vec![person],
        time: None,
    })
}

/// Reads the files that Sakai writes into each folder.
fn read_files_in_folder(parts: &Parts, files: &[Found]) -> Result<SubmissionRecord, Error> {
    let read = |name| read_text(files.iter().find_map(|found| found.node.find(name)));
    let members = read(SAKAI_MEMBERS)?;
    let members = read_members(members.as_deref().unwrap_or(parts.get("members")).trim());
    let people = members.unwrap_or_default().into_iter().map(|parts| Person {
        login: parts.get("eid").to_owned(),
        ..Person::named_by_file(parts.fill_first(&["{first} {last}", "{last}"]))
    });
    let people = people.collect();
    let time = read(SAKAI_TIME)?.map(|text| text.trim().to_owned());
    let time = time.map(|text| written_time(&text).unwrap_or(text));
    Ok(SubmissionRecord { people, time })
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

/// Returns the name that Canvas shows a page under: the last attachment's, if its first two numbers are
/// those that Canvas uses for the user and the attachment.
fn attachment_name(canvas: &Platform, files: &[Found]) -> Option<String> {
    let archive = files.iter().rfind(|found| found.node.is_archive());
    let Found { parts, node, .. } = archive.or(files.last())?;
    let is_zip = node.name.to_lowercase().ends_with(".zip");
    let end = if is_zip { "" } else { ".html" };
    let is_first = first_readings(canvas.files, &node.name).first() == Some(parts);
    is_first.then(|| format!("{}{end}", node.name))
}

fn person(platform: &Platform, parts: &Parts) -> Person {
    Person {
        name: parts.fill_first(platform.names),
        number: number(parts).to_owned(),
        login: parts.get("account").to_owned(),
        is_named_by_file: platform.is_named_by_file,
        ..Person::default()
    }
}

/// Returns the platform's number of the person or group.
fn number<'a>(parts: &Parts<'a>) -> &'a str {
    let fields = ["number", "participant", "anonymous"].map(|field| parts.get(field));
    fields
        .into_iter()
        .find(|number| !number.is_empty())
        .unwrap_or_default()
}

/// Returns the possible readings of a name by the first template that it follows.
fn first_readings<'a>(templates: &[&'static str], name: &'a str) -> Vec<Parts<'a>> {
    let ways = templates.iter().map(|template| readings(template, name));
    ways.into_iter()
        .find(|ways| !ways.is_empty())
        .unwrap_or_default()
}

/// Returns the entry of a file whose name can be read in several ways.
fn ambiguous(ways: &[Parts], node: &Node) -> Entry {
    let users = ways
        .iter()
        .map(|parts| format!("{} of {}", parts.get("number"), parts.get("canvas_name")));
    let users: Vec<String> = users.collect();
    let why = format!(
        "its name can be read with the user number {}: pass a gradebook that has one of them with \
         --canvas, or rename the file",
        users.join(" or ")
    );
    let person = Person::named_by_file(&node.name);
    let mut entry = Entry::new(&node.name, person, &node.name, Source::Missing(why));
    entry.info.needs_staff = true;
    entry.info.late = ways.iter().any(|parts| parts.has("late"));
    entry
}

/// Returns the common prefix of all names, cut off after its last separator, since the account names may
/// begin with the same letters too. For a single name, the prefix is empty, since nothing shows where
/// the account name begins.
pub(super) fn common_prefix<'a>(names: &[&'a str], separator: char) -> &'a str {
    let [first, others @ ..] = names else {
        return "";
    };
    let is_shared = |end: &usize| others.iter().all(|name| name.starts_with(&first[..*end]));
    let ends = first
        .rmatch_indices(separator)
        .map(|(at, sign)| at + sign.len());
    let end = ends.filter(|_| !others.is_empty()).find(is_shared);
    &first[..end.unwrap_or(0)]
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

/// Returns the name without the archive's extension.
fn strip_archive_extension(name: &str) -> &str {
    let lower = name.to_ascii_lowercase();
    let ends = [
        ".tar.gz", ".tar.xz", ".tar.bz2", ".tar.zst", ".tgz", ".txz", ".tar", ".zip", ".rar",
        ".7z", ".gz", ".xz",
    ];
    let end = ends.iter().find(|end| lower.ends_with(**end));
    &name[..name.len() - end.map_or(0, |end| end.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_common_prefix_of_repositories() {
        let names = [
            "cg-pathtracing-ann",
            "cg-pathtracing-ann-lee",
            "cg-pathtracing-bob",
        ];
        assert_eq!(common_prefix(&names, '-'), "cg-pathtracing-");
        assert_eq!(common_prefix(&names[..1], '-'), "");
    }

    #[test]
    fn removes_the_numbers_of_files_that_were_handed_in_again() {
        for (name, original) in [
            ("camera-12.rs", "camera.rs"),
            ("camera-final.rs", "camera-final.rs"),
        ] {
            assert_eq!(without_number(name), original);
        }
    }
}
