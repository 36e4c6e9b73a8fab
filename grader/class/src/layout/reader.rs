//! Reads a class according to its [`Platform`]: groups the files and folders of each submission,
//! and adds the people and times that the platform has recorded.

use std::collections::{BTreeMap, BTreeSet};

use grader::handed_out::HandedOut;

use super::canvas::{attachment_name, without_number};
use super::gradescope::read_metadata;
use super::names::SubmissionNode;
use super::platforms::{Platform, Record};
use super::records::{Receipts, SAKAI_ATTACHMENTS, SubmissionRecord, read_files_in_folder};
use super::template::Parts;
use super::times::normalize_time;
use super::{LayoutChoice, RecognisedClass, UnmatchedPath};
use crate::entry::{Entry, Person, Source};
use crate::error::Error;
use crate::file_tree::Node;
use crate::names::{are_same_name, joined};
use crate::roster::Member;

/// The reason for not grading submissions by users with the same number but different names.
const SHARED_NUMBER: &str = "another file has the same user number but a different name: rename \
                             it, or put each student's files into a separate folder";
/// The reason for not grading two files with the same name, which Canvas never exports.
const REPEATED_FILE: &str = "two of its files have the same name: remove the one that shouldn't be \
                             graded, or put each student's files into a separate folder";
/// The reason for not grading an archive that Canvas exports together with a newer one.
const OLDER: &str = "a newer archive with this name is graded instead";
/// The fields that may differ between the files of one submission.
const OF_FILES: [&str; 4] = ["file", "attachment", "late", "kind"];

/// Reads classes exported by a platform.
pub(super) struct Reader<'a> {
    pub platform: &'static Platform,
    pub handed_out: &'a HandedOut,
    /// The people on the class's lists.
    pub known: &'a [Member],
}

impl Reader<'_> {
    /// Returns the class in a folder. `metadata` is the text of Gradescope's file.
    pub fn read(
        &self,
        root: &Node,
        metadata: Option<&str>,
        choice: &LayoutChoice,
    ) -> Result<RecognisedClass, Error> {
        let platform = self.platform;
        let metadata = metadata.filter(|_| platform.record == Record::Metadata);
        let mut records = metadata.map(read_metadata).transpose()?.unwrap_or_default();
        let names = self.read_names(root, choice)?;
        let (mut entries, mut unmatched) = (names.ambiguous, names.unmatched);
        let mut groups: BTreeMap<Parts, Vec<SubmissionNode>> = BTreeMap::new();
        for found in names.found {
            let key = found.parts.without(&OF_FILES);
            groups.entry(key).or_default().push(found);
        }
        let mut names_of: BTreeMap<String, usize> = BTreeMap::new();
        for (parts, group) in &groups {
            let has_files = group.iter().any(|found| !found.is_text);
            *names_of.entry(number(parts)).or_default() += usize::from(has_files);
        }
        let receipts = Receipts::read(platform, &groups)?;
        for (mut parts, group) in groups {
            let (texts, files): (Vec<_>, Vec<_>) =
                group.into_iter().partition(|found| found.is_text);
            let record = match platform.record {
                Record::None => SubmissionRecord::default(),
                Record::Receipt => receipts.record(&mut parts),
                Record::FilesInFolder => read_files_in_folder(&parts, &files)?,
                Record::Metadata => match records.remove(parts.get("submission")) {
                    Some(record) => record,
                    None => {
                        let others = files.into_iter();
                        unmatched.extend(others.map(|found| self.unmatched(found.path)));
                        continue;
                    }
                },
            };
            let is_shared = names_of[&number(&parts)] > 1 && !files.is_empty();
            let mut entry = self.entry(&parts, files, texts, &mut unmatched);
            if platform.has_attachments && is_shared {
                entry.leave_to_staff(SHARED_NUMBER);
            }
            entries.push(record.describe(entry));
        }
        for (name, record) in records {
            let entry = Entry::left_to_staff(&name, "its folder is not in the export");
            entries.push(record.describe(entry));
        }
        Ok(RecognisedClass {
            layout: platform.layout,
            entries,
            unmatched,
            notes: names.notes,
            mixtures: Vec::new(),
        })
    }

    /// Returns whether a list contains the person's number together with a similar name, or a group
    /// with the person's name, since a group's files are named after the group.
    pub fn is_listed(&self, parts: &Parts) -> bool {
        let person = person(self.platform, parts);
        let mut members = self.known.iter().map(|member| &member.person);
        members.any(|member| {
            let is_group = !member.group.is_empty() && are_same_name(&member.group, &person.name);
            is_group || person.has_number(&member.number, &member.name)
        })
    }

    /// Returns the entry for a submission. Texts that are not graded are added to `others`.
    fn entry(
        &self,
        parts: &Parts,
        mut files: Vec<SubmissionNode>,
        mut texts: Vec<SubmissionNode>,
        others: &mut Vec<UnmatchedPath>,
    ) -> Entry {
        let platform = self.platform;
        files.sort_by_key(|found| found.parts.get("attachment").parse::<u64>().ok());
        let text = texts.pop_if(|_| files.is_empty());
        let from = match files.as_slice() {
            [others @ .., last] if platform.has_attachments && !others.is_empty() => {
                format!("{} and {} more", last.path, others.len())
            }
            files => {
                let folder = files.iter().find(|found| found.node.is_folder());
                let shown = folder.or(files.first()).or(text.as_ref());
                shown.map_or(String::new(), |found| found.path.clone())
            }
        };
        let why = match files.as_slice() {
            [] => Some(&platform.text_only),
            _ => platform.text_beside_files.as_ref(),
        };
        if let Some(why) = why {
            let texts = texts.into_iter();
            others.extend(texts.map(|found| UnmatchedPath::new(found.path, why)));
        }
        let id = parts.fill_first(&platform.ids);
        let source = self.source(&files, others);
        let mut entry = Entry::new(id, person(platform, parts), &from, source);
        // If files were handed in, the source can only be missing because of their names.
        entry.info.needs_staff = !files.is_empty() && matches!(entry.source, Source::Missing(_));
        let mut named = files.iter().chain(&text);
        entry.info.late = named.any(|found| found.parts.has("late"));
        entry.info.marks_late = platform.files.iter().any(|name| name.contains("{late}"));
        entry.info.attempt = parts.get("attempt").parse().ok();
        entry.info.submitted = normalize_time(parts.get("time"));
        entry.info.hand_back_as = if platform.has_attachments {
            attachment_name(platform, &files)
        } else {
            platform.hand_back.clone()
        };
        entry
    }

    /// Returns the location of a submission's files. Older archives are added to `others`.
    fn source(&self, files: &[SubmissionNode], others: &mut Vec<UnmatchedPath>) -> Source {
        let name = |found: &SubmissionNode| found.parts.get("file").to_owned();
        let is_folder = |found: &SubmissionNode| found.node.is_folder();
        if let [only] = files
            && (is_folder(only) || name(only).is_empty())
        {
            let is_sakai = self.platform.record == Record::FilesInFolder;
            let inside = only.node.find(SAKAI_ATTACHMENTS).filter(|_| is_sakai);
            return Source::Path(inside.unwrap_or(only.node).path.clone());
        }
        let names: BTreeSet<String> = files.iter().map(name).collect();
        let missing = |why: &str| Source::Missing(why.to_owned());
        if files.is_empty() {
            return missing(&self.platform.text_only);
        } else if files.iter().any(is_folder) {
            return missing(&several(files));
        } else if names.len() < files.len() {
            return missing(REPEATED_FILE);
        }
        let (mut counting, mut archives) = (Vec::new(), BTreeSet::new());
        let is_renamed = self.platform.has_attachments;
        // Files that were handed in again come later in the list.
        for found in files.iter().rev() {
            let base = without_number(&name(found));
            // If several archives were handed in under the same name, the newest is used. If none
            // of them has this name without a number, they can be parts: `part-1.zip`, `part-2.zip`.
            let is_version = is_renamed && found.node.is_archive() && names.contains(&base);
            if is_version && !archives.insert(base.clone()) {
                others.push(UnmatchedPath::new(&found.path, OLDER));
                continue;
            }
            // The names of files other than task files may themselves end in numbers.
            let is_task_file = is_renamed && self.handed_out.task_file(&base).is_some();
            let own = if is_task_file { base } else { name(found) };
            counting.push((own, found.node.path.clone()));
        }
        counting.reverse();
        Source::Files(counting)
    }
}

/// Returns the reason for not grading folders with the same name: they can be two downloads that
/// were unpacked into one folder, or the projects of namesakes in different tutorials.
fn several(folders: &[SubmissionNode]) -> String {
    let paths = folders.iter().map(|found| &found.path);
    format!(
        "there are several folders with this name ({}): keep only the one that should be graded, or \
         rename the folders if they are by different people",
        joined(paths, ", ")
    )
}

fn person(platform: &Platform, parts: &Parts) -> Person {
    Person {
        name: parts.fill_first(&platform.names),
        number: number(parts),
        login: parts.get("account").to_owned(),
        is_named_by_file: platform.is_named_by_file,
        ..Person::default()
    }
}

/// Returns the platform's number for the person or group.
fn number(parts: &Parts) -> String {
    parts.fill_first(&["{number}", "{participant}", "{anonymous}"])
}
