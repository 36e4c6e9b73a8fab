//! Checks that every name mentioned in the handout exists.
//!
//! Every identifier in inline code must occur in the sources that students see. For `Type::member`,
//! some file must declare the type and contain the member. Item ids must be in the exam, and files
//! must exist.

use std::collections::BTreeSet;

use judging::exam::Exam;

use super::pages::{Page, Snippet};
use super::{SourceFile, commands};

/// Identifiers in the handout that come from Rust or another crate rather than from the course.
const RUST_NAMES: [&str; 13] = [
    "Option",
    "Some",
    "None",
    "Vec3",
    "std",
    "glam",
    "usize",
    "unsafe",
    "println",
    "todo",
    "main",
    "sh",
    "split_at_mut",
];
/// C++ identifiers that the handout translates to Rust. They come from the language or the slides.
const CPP_NAMES: [&str; 6] = ["float", "norm", "norm_squared", "hmin", "hmax", "push_back"];

/// The sources, files and items that names can refer to.
#[derive(Debug)]
pub struct KnownNames<'a> {
    /// The code that students see, and the code that generates files for them.
    pub sources: &'a [SourceFile],
    /// The paths of all files in the repository, relative to its root.
    pub files: &'a BTreeSet<String>,
    /// The exam, whose item ids are known names.
    pub exam: &'a Exam,
}

/// Returns the unknown names on a page, each with its line number.
pub fn unknown_names(page: &Page, known: &KnownNames) -> Vec<String> {
    let words: BTreeSet<&str> = known
        .sources
        .iter()
        .flat_map(|source| identifiers(&source.text))
        .collect();
    // Pseudo-code defines names that the prose around it may use.
    let own: BTreeSet<&str> = page
        .blocks
        .iter()
        .flat_map(|block| identifiers(&block.text))
        .collect();
    let problem = |code: &&Snippet| {
        let text = code.text.as_str();
        let first = text.split(' ').next().unwrap_or_default();
        if first.starts_with("--") || first == "cargo" || commands::OTHER_COMMANDS.contains(&first)
        {
            // Commands are checked in `commands`.
            return None;
        }
        if let Some(item) = item_id(text, known.exam) {
            let there = known.exam.items.iter().any(|known| known.id == item);
            return (!there).then(|| format!("the exam has no item {item}"));
        }
        if is_path(text) {
            return (!path_exists(text, known)).then(|| format!("{text} does not exist"));
        }
        let parts = text.split("::").collect::<Vec<_>>();
        if let [owner, member] = parts[..]
            && is_identifier(owner)
            && is_identifier(member)
            && !RUST_NAMES.contains(&owner)
        {
            return (!has_member(owner, member, known))
                .then(|| format!("{owner} has no member {member}"));
        }
        let is_known = |word: &str| {
            let is_foreign = RUST_NAMES.contains(&word) || CPP_NAMES.contains(&word);
            let named = words.contains(word) || own.contains(word) || is_foreign;
            // JSON files contain the names of enum variants in snake case.
            named || words.contains(pascal_case(word).as_str())
        };
        let mut unknown = identifiers(text).filter(|word| word.len() > 1 && !is_known(word));
        unknown.next().map(|word| format!("unknown name {word}"))
    };
    let codes = page.inline_code.iter();
    codes
        .filter_map(|code| Some(page.problem(code, &problem(&code)?)))
        .collect()
}

/// Returns the item id in a string such as `sphere.from_inside` or `sphere.from_inside#7`.
fn item_id<'a>(text: &'a str, exam: &Exam) -> Option<&'a str> {
    let id = text.split('#').next()?;
    let (task, name) = id.split_once('.')?;
    let is_task = exam.items.iter().any(|item| item.task.id() == task);
    (is_task && is_identifier(name) && name != "rs").then_some(id)
}

/// Returns whether a string looks like a file or folder name.
fn is_path(text: &str) -> bool {
    let endings = [".rs", ".md", ".json", ".toml", ".obj", ".html", "/"];
    let plain = |letter: char| letter.is_alphanumeric() || "._-/".contains(letter);
    text.chars().all(plain) && (endings.iter().any(|ending| text.ends_with(ending)))
}

/// Returns whether a path exists. The path can be relative to the root, or it can be the end of any
/// file's path. A path that occurs in the sources is accepted too, because a program may write that
/// file.
fn path_exists(path: &str, known: &KnownNames) -> bool {
    let folder = path.strip_suffix('/');
    let named = |file: &String| match folder {
        Some(folder) => file.starts_with(&format!("{folder}/")),
        None => file == path || file.ends_with(&format!("/{path}")),
    };
    let written = |source: &SourceFile| source.text.contains(path.trim_end_matches('/'));
    known.files.iter().any(named) || known.sources.iter().any(written)
}

/// Returns whether some file declares the type `owner` and contains the name `member`.
fn has_member(owner: &str, member: &str, known: &KnownNames) -> bool {
    let declared = ["struct", "enum", "impl"].map(|kind| format!("{kind} {owner}"));
    known.sources.iter().any(|source| {
        let declares = declared.iter().any(|text| source.text.contains(text));
        declares && identifiers(&source.text).any(|word| word == member)
    })
}

fn is_identifier(text: &str) -> bool {
    let mut all = identifiers(text);
    all.next() == Some(text)
}

/// Converts snake case to Pascal case: `timed_out` to `TimedOut`.
fn pascal_case(word: &str) -> String {
    let parts = word.split('_').map(|part| {
        let mut letters = part.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    });
    parts.collect()
}

/// Returns the words of `text` that could be Rust identifiers.
fn identifiers(text: &str) -> impl Iterator<Item = &str> {
    let separates = |letter: char| !letter.is_alphanumeric() && letter != '_';
    let words = text.split(separates);
    words.filter(|word| word.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::items;

    fn problems(markdown: &str) -> Vec<String> {
        let sources = [SourceFile {
            path: "student/src/bvh.rs".to_owned(),
            text: "impl Bvh { pub fn build(max_leaf_size: usize) {} }".to_owned(),
        }];
        let files = BTreeSet::from(["student/src/bvh.rs".to_owned()]);
        let exam = items::exam_of_boxes();
        let known = KnownNames {
            sources: &sources,
            files: &files,
            exam: &exam,
        };
        unknown_names(&Page::new("a.md", markdown), &known)
    }

    #[test]
    fn existing_names_pass() {
        let text = "`Bvh::build` `max_leaf_size` `bbox.flat#3` `bvh.rs` `student/src/` `Option`";
        assert_eq!(problems(text), [""; 0]);
        let pseudo = "```text\nhit2.t\n```\nThe slides use `hit2.t`.";
        assert_eq!(problems(pseudo), [""; 0]);
    }

    #[test]
    fn reports_each_unknown_name_with_its_line() {
        let text = "`Bvh::grow`\n`max_leaf`\n`bbox.fat#3`\n`tree.rs`\n`starter/`";
        assert_eq!(
            problems(text),
            [
                "a.md:1: Bvh has no member grow",
                "a.md:2: unknown name max_leaf",
                "a.md:3: the exam has no item bbox.fat",
                "a.md:4: tree.rs does not exist",
                "a.md:5: starter/ does not exist",
            ]
        );
    }
}
