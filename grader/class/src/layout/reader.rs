//! Reads a class by its [`Platform`]: finds the submissions by the names of files and folders, and their
//! people and times by the names or by what the platform has written.

use std::collections::{BTreeMap, BTreeSet};

use grader::files;
use grader::handed_out::HandedOut;

use super::gradescope::read_metadata;
use super::mixture::is_section;
use super::platforms::{HandBackName, Holds, Platform, Record, SUBMISSIONS_SUFFIX};
use super::template::{Parts, read_members, readings};
use super::times::written_time;
use super::{Layout, LayoutContents, UnmatchedPath};
use crate::entry::{Entry, Person, Source};
use crate::error::Error;
use crate::listing::Node;
use crate::names::is_number;
use crate::roster::Member;

/// The reason for not grading users with one number and different names.
const SHARED_NUMBER: &str = "another file has the same user number with another name: rename it, or \
    put the files of each student into a folder of their own";
/// The reason for not grading two files of one name, which Canvas never has.
const REPEATED_FILE: &str = "two of its files have the same name: remove the one that does not count, \
    or put the files of each student into a folder of their own";
/// The reason for not grading two downloads that were unpacked into one folder.
const SEVERAL: &str = "it is in several folders of this name: keep the one that counts";
/// The fields that differ between the files of one submission.
const OF_FILES: [&str; 4] = ["file", "attachment", "late", "kind"];
/// Sakai's folder for the files that a student handed in. Other folders beside it have feedback.
const SAKAI_ATTACHMENTS: &str = "Submission attachment(s)";
/// Sakai's file with the submission time.
pub const SAKAI_TIME: &str = "timestamp.txt";
/// Sakai's file with the members of a group.
pub const SAKAI_MEMBERS: &str = "members.txt";

/// Everything apart from the class's folder that its entries depend on.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReadContext<'a> {
    /// The text of Gradescope's metadata file.
    pub metadata: Option<&'a str>,
    /// The assignment.
    pub handed_out: &'a HandedOut,
    /// The people on lists.
    pub known: &'a [Member],
    /// The title of the assignment, for a class with several.
    pub title: Option<&'a str>,
}

/// The people of a submission and its time, as the platform has recorded them. Unknown ones are empty.
#[derive(Debug, Default)]
pub(super) struct SubmissionRecord {
    pub people: Vec<Person>,
    pub time: Option<String>,
}

/// A file or folder whose name belongs to a submission.
#[derive(Clone, Debug)]
struct Found<'a> {
    parts: Parts<'a>,
    node: &'a Node,
    /// The path relative to the class's folder.
    path: String,
    is_text: bool,
}

/// The files and folders that were found in a class.
struct Search<'a> {
    platform: &'static Platform,
    context: ReadContext<'a>,
    found: Vec<Found<'a>>,
    /// The entries of files whose names can be read in several ways.
    ambiguous: Vec<Entry>,
    unmatched: Vec<UnmatchedPath>,
}

/// The files and folders of one submission, and its texts.
struct Group<'a> {
    platform: &'static Platform,
    /// The parts of the names that all of them share.
    parts: Parts<'a>,
    files: Vec<Found<'a>>,
    texts: Vec<Found<'a>>,
}

/// Returns whether a name follows one of the platform's templates.
pub(super) fn is_name(platform: &Platform, name: &str) -> bool {
    let mut templates = platform.files.iter().chain(platform.texts);
    templates.any(|template| !readings(template, name).is_empty())
}

/// Returns whether the files can be a download of Canvas, and not other files whose names have two
/// numbers, such as a date. In these, the same number or name is where Canvas has the students', or
/// two files have one attachment.
pub(super) fn is_canvas_download(canvas: &Platform, root: &Node, known: &[Member]) -> bool {
    let mut names: Vec<(bool, Parts)> = Vec::new();
    for node in root.children() {
        let first = first_readings(canvas.files, &node.name).into_iter().next();
        names.extend(first.map(|parts| (node.is_archive(), parts)));
    }
    if names
        .iter()
        .any(|(_, parts)| is_listed(canvas, parts, known))
    {
        return true;
    }
    let count = |templates: &[&'static str]| {
        let texts = names.iter().map(|(_, parts)| parts.fill_first(templates));
        texts.collect::<BTreeSet<String>>().len()
    };
    let users = count(canvas.ids);
    let whos = count(&["{canvas_name}", "anon"]);
    let attachments = count(&[
        "{canvas_name}_{number}_{attachment}",
        "anon_{anonymous}_{attachment}",
    ]);
    let archives = names.iter().filter(|(is_archive, _)| *is_archive).count();
    let mut anonymous = names.iter().map(|(_, parts)| parts.get("anonymous"));
    let is_anonymous = anonymous.all(|anonymous| !anonymous.is_empty());
    let is_of_one = (users == 1 && archives > 1) || (users > 1 && whos == 1 && !is_anonymous);
    attachments == names.len() && !is_of_one
}

/// Returns the entries of a class, and the paths that belong to none.
pub(super) fn read(
    platform: &'static Platform,
    root: &Node,
    context: ReadContext,
) -> Result<LayoutContents, Error> {
    let metadata = context
        .metadata
        .filter(|_| platform.record == Record::Metadata);
    let mut records = metadata.map(read_metadata).transpose()?.unwrap_or_default();
    let mut search = Search {
        platform,
        context,
        found: Vec::new(),
        ambiguous: Vec::new(),
        unmatched: Vec::new(),
    };
    search.visit(root, platform.outer_folders, &Parts::default(), "");
    search.choose_title()?;
    search.strip_prefix(root);
    let (mut entries, mut unmatched) = (search.ambiguous, search.unmatched);
    let groups = group(platform, search.found);
    let shared = shared_numbers(&groups);
    for mut group in groups {
        let has_shared_number = !group.files.is_empty() && shared.contains(number(&group.parts));
        let record = match platform.record {
            Record::None => SubmissionRecord::default(),
            Record::Receipt => group.read_receipt()?,
            Record::FilesInFolder => group.read_files_in_folder()?,
            Record::Metadata => match records.remove(group.parts.get("submission")) {
                Some(record) => record,
                None => {
                    let others = group.files.iter();
                    unmatched.extend(others.map(|found| found.unmatched(platform.unmatched)));
                    continue;
                }
            },
        };
        let mut entry = group.into_entry(context.handed_out, &mut unmatched);
        if has_shared_number {
            entry.source = Source::Missing(SHARED_NUMBER.to_owned());
        }
        entries.push(record.describe(entry));
    }
    for (name, record) in records {
        let source = Source::Missing("its folder is not in the export".to_owned());
        let entry = Entry::new(&name, Person::named_by_file(&name), &name, source);
        entries.push(record.describe(entry));
    }
    Ok((entries, unmatched))
}

impl<'a> Search<'a> {
    /// Finds the submissions in a folder. `levels` has the templates of the folders above them, `outer`
    /// the parts of the folders so far, and `above` their path.
    fn visit(
        &mut self,
        folder: &'a Node,
        levels: &[&'static [&'static str]],
        outer: &Parts<'a>,
        above: &str,
    ) {
        for node in folder.children() {
            let path = match above {
                "" => node.name.clone(),
                above => format!("{above}/{}", node.name),
            };
            if let [templates, inner @ ..] = levels {
                let own = first_readings(templates, &node.name).into_iter().next();
                match own.filter(|_| node.is_folder() && !node.is_link) {
                    Some(own) => self.visit(node, inner, &outer.join(&own), &path),
                    None => self.add_unmatched(path),
                }
            } else if self.is_section(node) && above.is_empty() {
                self.visit(node, levels, outer, &path);
            } else if !above.is_empty() || !self.platform.own_files.contains(&node.name.as_str()) {
                self.add(node, outer, path);
            }
        }
    }

    /// Returns whether a folder in a GitLab group is a subgroup, and not a repository.
    fn is_section(&self, node: &Node) -> bool {
        self.platform.layout == Layout::GitLab && is_section(node, self.context.handed_out)
    }

    /// Adds a file or folder that is in the place of a submission.
    fn add(&mut self, node: &'a Node, outer: &Parts<'a>, path: String) {
        let name = node.name.as_str();
        let mut ways = Vec::new();
        if self.platform.holds.can_be(node) {
            ways = first_readings(self.platform.files, name);
        }
        if self.platform.hand_back == HandBackName::Attachment {
            // The student's name and the file's may contain numbers as well.
            let is_listed = |parts: &Parts| is_listed(self.platform, parts, self.context.known);
            if ways.iter().filter(|parts| is_listed(parts)).count() == 1 {
                ways.retain(is_listed);
            }
        } else {
            ways.truncate(1);
        }
        let texts = || first_readings(self.platform.texts, name).into_iter().next();
        let (parts, is_text) = match ways.as_slice() {
            [_, _, ..] => return self.ambiguous.push(ambiguous(&ways, node)),
            [parts] => (parts.clone(), false),
            [] => match texts() {
                Some(parts) => (parts, true),
                None => return self.add_unmatched(path),
            },
        };
        let mut parts = outer.join(&parts);
        if self.platform.holds == Holds::FoldersAndArchives && !node.is_folder() {
            parts.set("name", strip_archive_extension(name));
            // A folder of the same name is another submission.
            parts.set("whole_name", name);
        }
        self.found.push(Found {
            parts,
            node,
            path,
            is_text,
        });
    }

    fn add_unmatched(&mut self, path: String) {
        self.unmatched.push(UnmatchedPath {
            name: path,
            why: self.platform.unmatched.to_owned(),
        });
    }

    /// Keeps the submissions of one assignment. Rejects a class with several, of which none is chosen.
    fn choose_title(&mut self) -> Result<(), Error> {
        let titles = self.found.iter().map(|found| found.parts.get("title"));
        let titles: BTreeSet<&str> = titles.filter(|title| !title.is_empty()).collect();
        let all = Vec::from_iter(titles.iter().copied()).join(", ");
        match self.context.title {
            Some(title) if titles.contains(title) => {
                self.found.retain(|found| found.parts.get("title") == title);
                Ok(())
            }
            Some(title) => Err(Error::user(format!(
                "no folder of an assignment has the title {title:?}; there are: {all}"
            ))),
            None if titles.len() > 1 => Err(Error::user(format!(
                "the input has several assignments ({all}): choose one with --title"
            ))),
            None => Ok(()),
        }
    }

    /// Removes the text with which all names begin, such as the assignment's title.
    fn strip_prefix(&mut self, root: &Node) {
        let Some(separator) = self.platform.prefix_end else {
            return;
        };
        let field = if self.platform.names.is_empty() {
            "account"
        } else {
            "name"
        };
        let names = self.found.iter().filter(|found| !found.node.is_link);
        let names: BTreeSet<&str> = names.map(|found| found.parts.get(field)).collect();
        let is_listed = |name: &&str| {
            let person = Person::named_by_file(*name);
            self.context
                .known
                .iter()
                .any(|member| member.matches(&person))
        };
        if field == "name" && names.iter().any(is_listed) {
            return;
        }
        let assignment = root.name.strip_suffix(SUBMISSIONS_SUFFIX);
        let prefix = match assignment.filter(|_| self.platform.layout == Layout::GitHub) {
            Some(assignment) => format!("{assignment}{separator}"),
            None => common_prefix(&Vec::from_iter(names), separator).to_owned(),
        };
        for Found { parts, .. } in &mut self.found {
            let whole = parts.get(field);
            parts.set("whole_name", whole);
            parts.set(field, whole.strip_prefix(&prefix).unwrap_or(whole));
        }
    }
}

impl Found<'_> {
    fn unmatched(&self, why: &str) -> UnmatchedPath {
        UnmatchedPath {
            name: self.path.clone(),
            why: why.to_owned(),
        }
    }

    fn is_late(&self) -> bool {
        !self.parts.get("late").is_empty()
    }
}

impl Holds {
    fn can_be(self, node: &Node) -> bool {
        match self {
            Holds::Files => !node.is_folder(),
            Holds::Folders => node.is_folder(),
            Holds::FilesAndFolders => true,
            Holds::FoldersAndArchives => node.is_folder() || node.is_archive(),
        }
    }
}

impl SubmissionRecord {
    /// Adds what is recorded to an entry.
    fn describe(self, mut entry: Entry) -> Entry {
        if !self.people.is_empty() {
            entry.info.people = self.people;
        }
        entry.info.submitted = self.time.or(entry.info.submitted);
        entry
    }
}

/// Groups files and folders by submission.
fn group<'a>(platform: &'static Platform, found: Vec<Found<'a>>) -> Vec<Group<'a>> {
    let mut groups: BTreeMap<Parts, Group> = BTreeMap::new();
    for found in found {
        let parts = found.parts.without(&OF_FILES);
        let group = groups.entry(parts.clone()).or_insert_with(|| Group {
            platform,
            parts,
            files: Vec::new(),
            texts: Vec::new(),
        });
        let list = if found.is_text {
            &mut group.texts
        } else {
            &mut group.files
        };
        list.push(found);
    }
    groups.into_values().collect()
}

/// Returns the numbers with which Canvas has different names.
fn shared_numbers<'a>(groups: &[Group<'a>]) -> BTreeSet<&'a str> {
    let (mut all, mut shared) = (BTreeSet::new(), BTreeSet::new());
    for Group {
        platform,
        parts,
        files,
        ..
    } in groups
    {
        if platform.hand_back == HandBackName::Attachment
            && !files.is_empty()
            && !all.insert(number(parts))
        {
            shared.insert(number(parts));
        }
    }
    shared
}

impl Group<'_> {
    /// Reads the first line of Blackboard's text file, `Name: Jane Doe (jdoe)`, in which the word before
    /// the colon depends on the language. The assignment's title and the account may contain `_`, so
    /// only this line tells where the account begins.
    fn read_receipt(&mut self) -> Result<SubmissionRecord, Error> {
        let Some(receipt) = self.texts.first() else {
            return Ok(SubmissionRecord::default());
        };
        let text = read_text(receipt.node)?;
        let line = text.lines().next().and_then(|line| line.split_once(": "));
        let name = line.and_then(|(_, name)| name.trim().strip_suffix(')')?.rsplit_once(" ("));
        let whole = self.parts.get("whole_name");
        let Some((name, account)) = name.filter(|(_, account)| {
            let title = whole.strip_suffix(account);
            title.is_some_and(|title| title.is_empty() || title.ends_with('_'))
        }) else {
            return Ok(SubmissionRecord::default());
        };
        self.parts
            .set("account", &whole[whole.len() - account.len()..]);
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
    fn read_files_in_folder(&self) -> Result<SubmissionRecord, Error> {
        let read = |name: &str| {
            let file = self.files.iter().find_map(|found| found.node.find(name));
            file.map(read_text).transpose()
        };
        let members = read(SAKAI_MEMBERS)?;
        let members = members.as_deref().unwrap_or(self.parts.get("members"));
        let person = |parts: Parts| Person {
            login: parts.get("account").to_owned(),
            ..Person::named_by_file(parts.fill_first(&["{first} {last}", "{last}"]))
        };
        let people = read_members(members.trim()).unwrap_or_default();
        let time = read(SAKAI_TIME)?.map(|text| text.trim().to_owned());
        Ok(SubmissionRecord {
            people: people.into_iter().map(person).collect(),
            time: time.map(|text| written_time(&text).unwrap_or(text)),
        })
    }

    /// Returns the entry of the submission. Texts that are not graded are added to `unmatched`.
    fn into_entry(mut self, handed_out: &HandedOut, unmatched: &mut Vec<UnmatchedPath>) -> Entry {
        let platform = self.platform;
        let is_canvas = platform.hand_back == HandBackName::Attachment;
        if is_canvas {
            let attachment = |found: &Found| found.parts.get("attachment").parse::<u64>().ok();
            self.files.sort_by_key(attachment);
        }
        let last_text = self.texts.pop();
        let mut late = self.files.iter().any(Found::is_late);
        let folder = self.files.iter().find(|found| found.node.is_folder());
        let (from, source) = match (self.files.as_slice(), folder, last_text) {
            ([], _, text) => {
                late = text.as_ref().is_some_and(Found::is_late);
                let others = self.texts.iter();
                unmatched.extend(others.map(|found| found.unmatched(platform.text_only)));
                let from = text.map(|text| text.path).unwrap_or_default();
                (from, Source::Missing(platform.text_only.to_owned()))
            }
            (files @ [first, ..], folder, text) => {
                if let Some(why) = platform.text_beside_files {
                    let texts = self.texts.iter().chain(&text);
                    unmatched.extend(texts.map(|found| found.unmatched(why)));
                }
                let from = match files {
                    [others @ .., last] if is_canvas && !others.is_empty() => {
                        format!("{} and {} more", last.path, others.len())
                    }
                    _ => folder.unwrap_or(first).path.clone(),
                };
                (from, source(files, folder, is_canvas, handed_out))
            }
        };
        let id = self.parts.fill_first(platform.ids);
        let mut entry = Entry::new(id, person(platform, &self.parts), &from, source);
        entry.info.late = late;
        entry.info.marks_late = platform.files.iter().any(|name| name.contains("{late}"));
        entry.info.submitted = written_time(self.parts.get("time"));
        entry.info.hand_back_as = match platform.hand_back {
            HandBackName::None => None,
            HandBackName::Marks(name) => Some(name.to_owned()),
            HandBackName::Attachment => attachment_name(platform, &self.files),
        };
        entry
    }
}

/// Returns the location of a submission's files.
fn source(
    files: &[Found],
    folder: Option<&Found>,
    is_canvas: bool,
    handed_out: &HandedOut,
) -> Source {
    if let Some(folder) = folder {
        return match files {
            [_] => {
                let attachments = folder.node.find(SAKAI_ATTACHMENTS);
                Source::Path(attachments.unwrap_or(folder.node).path.clone())
            }
            _ => Source::Missing(SEVERAL.to_owned()),
        };
    }
    let name = |found: &Found| found.parts.get("file").to_owned();
    if let [only] = files
        && name(only).is_empty()
    {
        return Source::Path(only.node.path.clone());
    }
    let names: BTreeSet<String> = files.iter().map(name).collect();
    if names.len() < files.len() {
        return Source::Missing(REPEATED_FILE.to_owned());
    }
    // Of the archives that were handed in under one name, the newest counts. Files that were handed in
    // again come later in the list.
    let is_replaced = |index: usize| {
        let is_archive = |found: &&Found| found.node.is_archive();
        let base = |found: &Found| without_number(&name(found));
        let own = Some(&files[index]).filter(is_archive);
        let mut later = files[index + 1..].iter().filter(is_archive);
        own.is_some_and(|own| later.any(|other| base(other) == base(own)))
    };
    let counting = (0..files.len()).filter(|index| !is_canvas || !is_replaced(*index));
    let counting = counting.map(|index| {
        let own = if is_canvas {
            original_name(&name(&files[index]), handed_out)
        } else {
            name(&files[index])
        };
        (own, files[index].node.path.clone())
    });
    Source::Files(counting.collect())
}

/// Returns the name under which Canvas shows a page: that of the last attachment, if Canvas takes the first
/// two numbers in it for the user's and the attachment's.
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

/// Returns whether a list has the person's number with a name like the person's.
fn is_listed(platform: &Platform, parts: &Parts, known: &[Member]) -> bool {
    let person = person(platform, parts);
    let mut members = known.iter().map(|member| &member.person);
    members.any(|member| person.has_number(&member.number, &member.name))
}

/// Returns the ways to read a name by the first template that it follows.
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
    entry.info.late = ways.iter().any(|parts| !parts.get("late").is_empty());
    entry
}

/// Returns the common prefix of all names, cut off after its last separator, since the account names may
/// begin with the same letters as well. For a single name, the prefix is empty, since nothing shows
/// where the account name begins.
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

/// Returns `camera.rs` for `camera-2.rs`. Changes only the names of task files, since other names may
/// end in a number of their own.
fn original_name(name: &str, handed_out: &HandedOut) -> String {
    let original = without_number(name);
    match handed_out.task_file(&original) {
        Some(_) => original,
        None => name.to_owned(),
    }
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

/// Reads a file that the platform has written.
fn read_text(node: &Node) -> Result<String, Error> {
    let bytes = files::read(&node.path).map_err(Error::user)?;
    let text = String::from_utf8_lossy(&bytes);
    Ok(text.trim_start_matches('\u{feff}').to_owned())
}

#[cfg(test)]
mod tests {
    use grader::handed_out::RAYS;

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
    fn removes_canvas_numbers_from_task_file_names_only() {
        assert_eq!(original_name("camera-12.rs", &RAYS), "camera.rs");
        assert_eq!(original_name("camera-final.rs", &RAYS), "camera-final.rs");
        assert_eq!(original_name("scene-2.rs", &RAYS), "scene-2.rs");
    }
}
