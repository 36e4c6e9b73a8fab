//! Templates for the names that platforms give to files and folders, such as
//! `{name}[_{number}]_assignsubmission_file[_{file}]`: text, fields in braces, and optional parts
//! in brackets. A field matches as little text as possible, and its name determines which texts it
//! accepts.

use std::collections::BTreeMap;

use super::times::normalize_time;
use crate::names::is_number;

/// The template for one person in a folder name from Sakai or in Sakai's list of a group's members.
/// Sakai removes letters that aren't Latin.
const MEMBER: &str = "[{last}],[ ][{first}]({eid})";

/// The texts in the fields of a template.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Parts<'a>(BTreeMap<&'static str, &'a str>);

impl<'a> Parts<'a> {
    /// Returns the text in a field, or an empty string if the name doesn't contain the field.
    pub fn get(&self, field: &str) -> &'a str {
        self.0.get(field).copied().unwrap_or_default()
    }

    /// Returns whether the name contains the field.
    pub fn has(&self, field: &str) -> bool {
        !self.get(field).is_empty()
    }

    /// Sets the text in a field.
    pub fn set(&mut self, field: &'static str, text: &'a str) {
        self.0.insert(field, text);
    }

    /// Returns the parts without these fields.
    pub fn without(&self, fields: &[&str]) -> Self {
        let others = self.0.iter().filter(|(field, _)| !fields.contains(field));
        Parts(others.map(|(field, text)| (*field, *text)).collect())
    }

    /// Returns the parts of both names.
    pub fn join(&self, other: &Parts<'a>) -> Self {
        let both = self.0.iter().chain(&other.0);
        Parts(both.map(|(field, text)| (*field, *text)).collect())
    }

    /// Fills in the first template whose fields all have text. If there is none, returns an empty
    /// string. Parts in brackets are left out if a field in them is empty.
    pub fn fill_first(&self, templates: &[impl AsRef<str>]) -> String {
        let templates = templates.iter().map(AsRef::as_ref);
        let mut filled = templates.filter_map(|template| self.fill(template));
        filled.next().unwrap_or_default()
    }

    fn fill(&self, mut template: &str) -> Option<String> {
        let mut text = String::new();
        while let Some((item, rest)) = next_item(template) {
            match item {
                Item::Text(own) => text += own,
                Item::Field(field) => {
                    text += Some(self.get(field)).filter(|own| !own.is_empty())?
                }
                Item::Optional(inside) => text += &self.fill(inside).unwrap_or_default(),
            }
            template = rest;
        }
        Some(text)
    }
}

/// Returns all the ways to read a name according to a template, the most likely one first.
pub fn readings<'a>(template: &'static str, name: &'a str) -> Vec<Parts<'a>> {
    let mut found = Vec::new();
    find_readings(vec![template], name, &Parts::default(), &mut found);
    found
}

/// Returns the people in a string such as `Lee, Ann(ann); Kim, Bob(bob)`, or `None` if it has a
/// different form.
pub fn read_members(text: &str) -> Option<Vec<Parts<'_>>> {
    let members = text.split("; ");
    let members = members.map(|member| readings(MEMBER, member.trim()));
    members.map(|ways| ways.into_iter().next()).collect()
}

/// An item at the beginning of a template.
enum Item<'t> {
    Text(&'t str),
    Field(&'t str),
    Optional(&'t str),
}

/// Splits off the first item of a template. Returns `None` at the end of the template.
fn next_item(template: &str) -> Option<(Item<'_>, &str)> {
    if let Some(rest) = template.strip_prefix('{') {
        let (field, rest) = rest.split_once('}')?;
        Some((Item::Field(field), rest))
    } else if let Some(rest) = template.strip_prefix('[') {
        let (inside, rest) = rest.split_once(']')?;
        Some((Item::Optional(inside), rest))
    } else {
        let end = template.find(['{', '[']).unwrap_or(template.len());
        let (text, rest) = template.split_at(end);
        (end > 0).then_some((Item::Text(text), rest))
    }
}

/// Adds all the ways to read a string according to the templates in `pending`, beginning with the
/// last template.
fn find_readings<'a>(
    mut pending: Vec<&'static str>,
    text: &'a str,
    parts: &Parts<'a>,
    found: &mut Vec<Parts<'a>>,
) {
    let next = pending.pop().map(next_item);
    match next {
        None if text.is_empty() => found.push(parts.clone()),
        None => {}
        Some(None) => find_readings(pending, text, parts, found),
        Some(Some((item, rest))) => {
            pending.push(rest);
            match item {
                Item::Text(own) => {
                    if let Some(text) = text.strip_prefix(own) {
                        find_readings(pending, text, parts, found);
                    }
                }
                Item::Optional(inside) => {
                    let mut with = pending.clone();
                    with.push(inside);
                    find_readings(with, text, parts, found);
                    find_readings(pending, text, parts, found);
                }
                Item::Field(field) => {
                    let ends = text.char_indices().map(|(end, _)| end);
                    for end in ends.chain([text.len()]) {
                        let (own, after) = text.split_at(end);
                        // Comparing the text that comes next is fast and rules out most ends of the
                        // field.
                        if may_follow(&pending, after) && fits(field, own) {
                            let mut parts = parts.clone();
                            parts.set(field, own);
                            find_readings(pending.clone(), after, &parts, found);
                        }
                    }
                }
            }
        }
    }
}

/// Returns whether a string could match the pending templates, judging only by the first item in
/// them.
fn may_follow(pending: &[&'static str], text: &str) -> bool {
    match pending.iter().rev().find_map(|own| next_item(own)) {
        None => text.is_empty(),
        Some((Item::Text(own), _)) => text.starts_with(own),
        Some((Item::Field(_) | Item::Optional(_), _)) => true,
    }
}

/// Returns whether a string can be the value of the field with this name.
fn fits(field: &str, text: &str) -> bool {
    match field {
        "canvas_name" => is_canvas_name(text),
        "number" | "participant" | "folder" | "attempt" => is_number(text),
        "attachment" => is_number(text) && text.parse::<u64>().is_ok(),
        "kind" => !text.contains('_'),
        "anonymous" => !text.is_empty() && !text.contains('_'),
        "late" => text == "LATE",
        "time" => normalize_time(text).is_some(),
        "eid" => !text.is_empty() && !text.contains(['(', ')']),
        "members" => read_members(text).is_some(),
        "uuid" => text.len() == 36 && text.chars().all(|c| c.is_ascii_hexdigit() || c == '-'),
        "file" => true,
        _ => !text.is_empty(),
    }
}

/// Returns whether a string can be a student's name as Canvas writes it. Unlike a date, the name
/// contains a letter. Its middle parts aren't numbers, because Canvas removes numbers there. `LATE`
/// after the name is not part of it.
fn is_canvas_name(name: &str) -> bool {
    let parts: Vec<&str> = name.split('_').collect();
    let inner = parts.get(1..parts.len() - 1).unwrap_or_default();
    name.chars().any(char::is_alphabetic)
        && !inner.iter().any(|part| is_number(part))
        && !name.ends_with("_LATE")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the readings of a name, each filled into the template `shown`.
    fn read(template: &'static str, shown: &'static str, name: &str) -> Vec<String> {
        let ways = readings(template, name).into_iter();
        ways.map(|parts| parts.fill_first(&[shown])).collect()
    }

    #[test]
    fn a_name_is_split_at_the_texts_of_the_template() {
        let moodle = "{name}[_{number}]_assignsubmission_file[_{file}]";
        let read_moodle = |name| {
            read(moodle, "{name}|[{number}]|[{file}]", name)
                .into_iter()
                .next()
        };
        for (name, expected) in [
            (
                "José, Jr._12_assignsubmission_file_my_a.rs",
                Some("José, Jr.|12|my_a.rs"),
            ),
            (
                "Default group_assignsubmission_file_",
                Some("Default group||"),
            ),
            ("_assignsubmission_file_", None),
        ] {
            assert_eq!(read_moodle(name).as_deref(), expected);
        }
    }

    #[test]
    fn fields_accept_only_texts_of_their_kind() {
        let name = |text| read("{number}-{folder} - {name} - {time}", "{name}", text);
        let ann = "104840-170649 - Ann - Marie Lee - Nov 26, 2025 933 PM";
        assert_eq!(name(ann), ["Ann - Marie Lee"]);
        assert!(name("104840-170649 - Ann - Marie").is_empty());
        let members = read_members("Lee, Ann (Annie)(ann); Kim,(bob)").unwrap();
        let shown = members
            .iter()
            .map(|member| member.fill_first(&["[{first} ]{last} {eid}"]));
        assert_eq!(Vec::from_iter(shown), ["Ann (Annie) Lee ann", "Kim bob"]);
        assert_eq!(read_members("Ann Lee"), None);
    }

    #[test]
    fn a_name_that_follows_a_template_in_two_ways_has_two_readings() {
        let canvas = "{canvas_name}[_{late}]_{number}_{attachment}_{file}";
        let users = |name| read(canvas, "{canvas_name} {number}", name);
        assert_eq!(
            users("doejane_LATE_7001_9001_my_work-1.zip"),
            ["doejane 7001"]
        );
        assert_eq!(users("red_2_7001_9001_hw.zip"), ["red 2", "red_2 7001"]);
        for none in [
            "doejane_7001_text.html",
            "7001_9001_hw.zip",
            "2026_11_21_jdoe.zip",
        ] {
            assert!(users(none).is_empty(), "{none}");
        }
    }
}
