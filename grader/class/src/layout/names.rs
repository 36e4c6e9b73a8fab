//! Finds the submissions of a class by the names of files and folders.

use std::collections::{BTreeMap, BTreeSet};
use std::iter;

use grader::submission::strip_archive_extension;
use judging::sanitize::sanitize_line;

use super::canvas::ambiguous;
use super::mixture::is_section;
use super::platforms::{NodeKind, Platform, SUBMISSIONS_SUFFIX};
use super::reader::Reader;
use super::template::{Parts, readings};
use super::{Layout, LayoutChoice, UnmatchedPath};
use crate::entry::Entry;
use crate::error::Error;
use crate::file_tree::Node;
use crate::names::{fold, fold_name, joined};
use crate::roster::read_downloaded;

/// The maximum length of a list of titles in a message, in characters.
const MAX_CHARS: usize = 400;
/// A file or folder that, according to its name, belongs to a submission.
pub(super) struct SubmissionNode<'a> {
    pub parts: Parts<'a>,
    pub node: &'a Node,
    /// The path relative to the class's folder.
    pub path: String,
    pub is_text: bool,
}

/// The names that were read from a class's folder.
#[derive(Default)]
pub(super) struct Names<'a> {
    pub found: Vec<SubmissionNode<'a>>,
    /// The entries for files whose names can be read in several ways.
    pub ambiguous: Vec<Entry>,
    pub unmatched: Vec<UnmatchedPath>,
    /// Sentences about how the names were read, for a person to check.
    pub notes: Vec<String>,
}

/// Returns whether a name in the class's folder matches one of the platform's templates.
pub(super) fn is_name(platform: &'static Platform, name: &str) -> bool {
    let outermost = platform.outer_folders.first();
    let templates = [outermost.unwrap_or(&platform.files), &platform.texts];
    let mut ways = templates.map(|all| first_readings(all, name)).into_iter();
    ways.any(|ways| !ways.is_empty())
}

impl Reader<'_> {
    /// Returns the names in a class's folder that belong to the chosen assignment.
    pub fn read_names<'a>(
        &self,
        root: &'a Node,
        choice: &LayoutChoice,
    ) -> Result<Names<'a>, Error> {
        self.reject_nested_sections(root)?;
        let (mut names, outer) = (Names::default(), Parts::default());
        self.visit(root, &self.platform.outer_folders, &outer, "", &mut names);
        choose_title(&mut names.found, choice)?;
        self.strip_prefix(root, &mut names)?;
        Ok(names)
    }

    /// Reads the names in a folder. `levels` contains the templates for the levels of folders
    /// between this folder and the submissions, `outer` contains the parts read from the names of
    /// this folder and its parents, and `above` is this folder's path, which is empty or ends in a
    /// slash.
    fn visit<'a>(
        &self,
        folder: &'a Node,
        levels: &'static [Vec<String>],
        outer: &Parts<'a>,
        above: &str,
        names: &mut Names<'a>,
    ) {
        let may_have_sections = above.is_empty() && self.has_sections(folder);
        for node in folder.children() {
            let path = format!("{above}{}", node.name);
            let below = format!("{path}/");
            if let [templates, inner @ ..] = levels {
                let own = first_readings(templates, &node.name).into_iter().next();
                match own.filter(|_| node.is_folder() && !node.is_link) {
                    Some(own) => self.visit(node, inner, &outer.join(&own), &below, names),
                    None => names.unmatched.push(self.unmatched(path)),
                }
            } else if may_have_sections && is_section(node, self.handed_out) {
                self.visit(node, levels, outer, &below, names);
            } else if node.is_folder() || !self.platform.own_files.contains(&path) {
                self.add(node, outer, path, names);
            }
        }
    }

    /// Returns the folders for GitLab's subgroups, such as tutorials.
    fn sections<'a>(&self, folder: &'a Node) -> Vec<&'a Node> {
        let is_gitlab = self.platform.layout == Layout::GitLab;
        let is_section = |node: &&Node| is_gitlab && is_section(node, self.handed_out);
        folder.children().iter().filter(is_section).collect()
    }

    /// Returns whether the subgroups contain several people's projects. If the projects in all
    /// subgroups have the same name, each subgroup belongs to one person.
    fn has_sections(&self, folder: &Node) -> bool {
        let sections = self.sections(folder);
        let inside = sections.iter().flat_map(|section| section.children());
        let projects = inside.filter(|node| node.is_folder());
        let projects: BTreeSet<&str> = projects.map(|node| node.name.as_str()).collect();
        sections.len() == 1 || projects.len() > 1
    }

    /// Rejects a folder that contains a GitLab group's folder rather than the group's subgroups.
    /// Otherwise, each subgroup would be graded as one submission.
    fn reject_nested_sections(&self, root: &Node) -> Result<(), Error> {
        for group in self.sections(root) {
            let subgroups = self.sections(group);
            let folders = group.children().iter().filter(|node| node.is_folder());
            if 2 * subgroups.len() > folders.count() {
                let names = subgroups.iter().map(|node| &node.name);
                let names = sanitize_line(&joined(names, ", "), MAX_CHARS);
                let group = sanitize_line(&group.name, MAX_CHARS);
                return Err(Error::user(format!(
                    "the folder {group} contains folders with several projects ({names}), and each \
                     of these folders would be graded as one submission: pass the path of the \
                     folder {group} (if it is in an archive, unpack the archive first)"
                )));
            }
        }
        Ok(())
    }

    /// Adds a file or folder at the level of the submissions.
    fn add<'a>(&self, node: &'a Node, outer: &Parts<'a>, path: String, names: &mut Names<'a>) {
        let mut ways = Vec::new();
        if self.platform.submissions.includes(node) {
            ways = first_readings(&self.platform.files, &node.name);
        }
        if !self.platform.has_attachments {
            ways.truncate(1);
        } else if ways.iter().filter(|parts| self.is_listed(parts)).count() == 1 {
            // The student's name and the file name may contain numbers as well.
            ways.retain(|parts| self.is_listed(parts));
        }
        if ways.len() > 1 {
            names.ambiguous.push(ambiguous(&ways, node));
            return;
        }
        let is_text = ways.is_empty();
        if is_text {
            ways = first_readings(&self.platform.texts, &node.name);
        }
        let Some(own) = ways.first() else {
            names.unmatched.push(self.unmatched(path));
            return;
        };
        let mut parts = outer.join(own);
        if self.platform.layout == Layout::Plain && !node.is_folder() {
            // A folder with the same name as an archive is a different submission.
            parts.set("whole_name", &node.name);
            parts.set("name", strip_archive_extension(&node.name));
        }
        names.found.push(SubmissionNode {
            parts,
            node,
            path,
            is_text,
        });
    }

    /// Returns the path of a file or folder whose name doesn't match any template.
    pub fn unmatched(&self, path: String) -> UnmatchedPath {
        UnmatchedPath::new(path, &self.platform.unmatched)
    }

    /// Removes the prefix that the names share, such as the assignment's title. Names without the
    /// prefix are left unchanged and listed in a note.
    fn strip_prefix(&self, root: &Node, names: &mut Names) -> Result<(), Error> {
        let Some((field, separator)) = &self.platform.prefixed else {
            return Ok(());
        };
        let all = names.found.iter().filter(|found| !found.node.is_link);
        let all: BTreeSet<&str> = all.map(|found| found.parts.get(field)).collect();
        let all = Vec::from_iter(all);
        let assignment = root.name.strip_suffix(SUBMISSIONS_SUFFIX);
        let prefix = match assignment.filter(|_| self.platform.layout == Layout::GitHub) {
            Some(assignment) => format!("{assignment}{separator}"),
            None => match self.listed_prefix(root, &all, *separator) {
                Some(prefix) => prefix.to_owned(),
                None if self.platform.submissions == NodeKind::Folders => {
                    unlisted_prefix(&all, *separator)?.to_owned()
                }
                None => common_prefix(&all, *separator).to_owned(),
            },
        };
        let odd = all.iter().filter(|name| !name.starts_with(&prefix));
        let odd = sanitize_line(&joined(odd, ", "), MAX_CHARS);
        if !odd.is_empty() && is_majority(&prefix, &all) {
            names.notes.push(format!(
                "most folder names begin with {prefix}, unlike {odd}: if any of these are from \
                 another assignment or from staff, move them elsewhere"
            ));
        }
        for SubmissionNode { parts, .. } in &mut names.found {
            let whole = parts.get(field);
            parts.set("whole_name", whole);
            parts.set(field, whole.strip_prefix(&prefix).unwrap_or(whole));
        }
        Ok(())
    }

    /// Of the prefixes that more than half of the names share, returns the one that is most often
    /// followed by an identifier of somebody on the lists. People's names are only considered if no
    /// identifiers are found. If several prefixes are equally frequent, returns an empty string. If
    /// there is no such prefix, returns `None`.
    fn listed_prefix<'a>(
        &self,
        root: &Node,
        names: &[&'a str],
        separator: char,
    ) -> Option<&'a str> {
        let list = self.platform.layout.find_list(root);
        let downloaded = list.map(|path| read_downloaded(&path)).unwrap_or_default();
        let people = || {
            let members = self.known.iter().chain(&downloaded);
            members.map(|member| &member.person)
        };
        let identifiers = people().flat_map(|person| person.own_identifiers().map(fold));
        let by_identifier = most_frequent_prefix(names, separator, fold, &identifiers.collect());
        by_identifier.or_else(|| {
            let listed = people().map(|person| fold_name(&person.name));
            most_frequent_prefix(names, separator, fold_name, &listed.collect())
        })
    }
}

/// Among the prefixes shared by more than half of the names, returns the one most often followed by
/// one of the `listed` strings. If several prefixes are equally frequent, returns an empty string.
/// `normalize` is applied to the text after a prefix before it is compared.
fn most_frequent_prefix<'a>(
    names: &[&'a str],
    separator: char,
    normalize: fn(&str) -> String,
    listed: &BTreeSet<String>,
) -> Option<&'a str> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for name in names {
        for prefix in prefixes(name, separator) {
            let rest = normalize(&name[prefix.len()..]);
            if !rest.is_empty() && listed.contains(&rest) {
                *counts.entry(prefix).or_default() += 1;
            }
        }
    }
    counts.retain(|prefix, _| is_majority(prefix, names));
    let most = counts.values().copied().max()?;
    let mut best = counts.into_iter().filter(|(_, count)| *count == most);
    match (best.next(), best.next()) {
        (Some((prefix, _)), None) => Some(prefix),
        _ => Some(""),
    }
}

/// Returns the prefix that all names share. If more than half of them share a longer prefix, the
/// others could belong to another assignment, so the class is rejected.
fn unlisted_prefix<'a>(names: &[&'a str], separator: char) -> Result<&'a str, Error> {
    let shared = common_prefix(names, separator);
    let longer = names.iter().flat_map(|name| prefixes(name, separator));
    let longer = longer.filter(|prefix| prefix.len() > shared.len() && is_majority(prefix, names));
    let longer = longer.max_by_key(|prefix| prefix.len());
    let Some(longer) = longer.filter(|_| names.len() > 1) else {
        return Ok(shared);
    };
    let odd = names.iter().filter(|name| !name.starts_with(longer));
    let odd = sanitize_line(&joined(odd, ", "), MAX_CHARS);
    Err(Error::user(format!(
        "most folder names begin with {longer}, unlike {odd}, so it is unclear where the students' \
         names begin: if any of these are from another assignment or from staff, move them \
         elsewhere; otherwise, pass a list with the students' accounts or names, for example with \
         --roster"
    )))
}

/// Returns the prefixes of a name that end in the separator, and the empty string.
fn prefixes(name: &str, separator: char) -> impl Iterator<Item = &str> {
    let ends = name.match_indices(separator);
    let ends = ends.map(|(at, sign)| at + sign.len());
    iter::once(0).chain(ends).map(|end| &name[..end])
}

/// Returns whether more than half of the names begin with the prefix.
fn is_majority(prefix: &str, names: &[&str]) -> bool {
    let count = names.iter().filter(|name| name.starts_with(prefix)).count();
    2 * count > names.len()
}

/// Keeps the submissions of one assignment. Rejects a class with several assignments if none was
/// chosen.
fn choose_title(found: &mut Vec<SubmissionNode>, choice: &LayoutChoice) -> Result<(), Error> {
    let titles = found.iter().map(|found| found.parts.get("title"));
    let titles: BTreeSet<&str> = titles.filter(|title| !title.is_empty()).collect();
    let all = sanitize_line(&joined(&titles, ", "), MAX_CHARS);
    match choice.title.as_deref() {
        Some(title) if !titles.contains(title) => Err(Error::user(format!(
            "no assignment has the title {title:?}; the titles are: {all}"
        ))),
        None if titles.len() > 1 => Err(Error::user(format!(
            "the input contains several assignments ({all}): choose one with --title"
        ))),
        title => {
            found.retain(|found| title.is_none_or(|title| found.parts.get("title") == title));
            Ok(())
        }
    }
}

/// Returns the possible readings of a name according to the first template that it matches.
pub(super) fn first_readings<'a>(templates: &'static [String], name: &'a str) -> Vec<Parts<'a>> {
    let mut ways = templates.iter().map(|template| readings(template, name));
    ways.find(|ways| !ways.is_empty()).unwrap_or_default()
}

/// Returns the common prefix of all names, cut off after its last separator, since the account
/// names may happen to begin with the same letters. For a single name, the prefix is empty, since
/// it is unclear where the account name begins.
pub(super) fn common_prefix<'a>(names: &[&'a str], separator: char) -> &'a str {
    let [first, others @ ..] = names else {
        return "";
    };
    let is_shared = |end: &usize| others.iter().all(|name| name.starts_with(&first[..*end]));
    let ends = first.rmatch_indices(separator);
    let ends = ends.map(|(at, sign)| at + sign.len());
    let end = ends.filter(|_| !others.is_empty()).find(is_shared);
    &first[..end.unwrap_or(0)]
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
}
