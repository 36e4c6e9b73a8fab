//! Checks that no file that people read contains a phrase that is always wrong here (see "Language"
//! in `.github/CONTRIBUTING.md`). The other rules of that section are left to reviewers.

use std::fs;
use std::path::{Path, PathBuf};

use crate::harness::workspace;

/// Phrases to avoid, each as a list of words, with the text to write instead.
const PHRASES: [(&[&str], &str); 9] = [
    (&["can", "not"], "cannot"),
    (&["whoever"], "the person meant, such as \"the caller\""),
    (&["mend"], "fix"),
    (&["mends"], "fixes"),
    (&["mended"], "fixed"),
    (&["mending"], "fixing"),
    (&["begun"], "started"),
    (&["orphan"], "unreferenced primitive"),
    (&["orphans"], "unreferenced primitives"),
];

/// Beginnings of doc comments that do not say what the item is or does.
const FIRST_WORDS: [&str; 5] = ["What ", "Which.", "Where.", "Whoever ", "Said of "];

/// Paths that are not checked: generated files, files by others, and this file, which quotes the
/// phrases.
const SKIPPED: [&str; 9] = [
    "target",
    ".git",
    "grader/fuzz/corpus",
    "grader/fuzz/target",
    "grader/tests/browser/axe",
    "grader/tests/it/language.rs",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "Cargo.lock",
];

/// Extensions of files that people read.
const ENDINGS: [&str; 10] = [
    "rs", "md", "toml", "yml", "yaml", "html", "css", "js", "snap", "sh",
];

/// Collects the files below `folder` that are checked.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let path = entry.path();
        let from_root = path.strip_prefix(workspace()).unwrap();
        if SKIPPED
            .iter()
            .any(|skipped| Path::new(skipped) == from_root)
        {
            continue;
        }
        if entry.file_type().unwrap().is_dir() {
            collect(&path, files);
        } else if path
            .extension()
            .is_some_and(|ending| ENDINGS.iter().any(|read| *read == ending))
        {
            files.push(path);
        }
    }
}

/// Returns the words of a text in lower case, each with its 1-based line number. The words of all
/// lines are in one list, so that a phrase such as "can not" is also found across a line break. In
/// Markdown, text in double quotes is skipped, because it is a quotation.
fn words(text: &str, is_markdown: bool) -> Vec<(usize, String)> {
    let mut words = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let is_quoted = |part: &usize| is_markdown && part % 2 == 1;
        let parts = line.split('"').enumerate();
        for (_, part) in parts.filter(|(part, _)| !is_quoted(part)) {
            let found = part.split(|c: char| !c.is_alphabetic());
            let found = found.filter(|word| !word.is_empty());
            words.extend(found.map(|word| (number + 1, word.to_lowercase())));
        }
    }
    words
}

/// Returns a message for each phrase to avoid, and for each doc comment that begins with a wrong
/// word.
fn complaints(name: &str, text: &str) -> Vec<String> {
    let mut complaints = Vec::new();
    let words = words(text, name.ends_with(".md"));
    for (phrase, instead) in PHRASES {
        for found in words.windows(phrase.len()) {
            if found.iter().map(|(_, word)| word).eq(phrase) {
                let (line, phrase) = (found[0].0, phrase.join(" "));
                complaints.push(format!("{name}:{line}: \"{phrase}\": write {instead}"));
            }
        }
    }
    let mut is_inside = false;
    for (number, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let doc = line.strip_prefix("///").or(line.strip_prefix("//!"));
        let first = doc.map(str::trim_start).filter(|_| !is_inside);
        is_inside = doc.is_some();
        let wrong = first.and_then(|text| FIRST_WORDS.iter().find(|word| text.starts_with(**word)));
        if let Some(word) = wrong {
            complaints.push(format!(
                "{name}:{}: a doc comment begins with \"{}\": say what the item is or does",
                number + 1,
                word.trim_end()
            ));
        }
    }
    complaints
}

#[test]
fn no_text_has_a_phrase_that_is_always_wrong() {
    let mut files = Vec::new();
    collect(&workspace(), &mut files);
    assert!(files.len() > 500, "{} files", files.len());
    let complaints = files.iter().flat_map(|path| {
        let name = path
            .strip_prefix(workspace())
            .unwrap()
            .display()
            .to_string();
        complaints(&name.replace('\\', "/"), &fs::read_to_string(path).unwrap())
    });
    let complaints: Vec<String> = complaints.collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn finds_phrases_over_line_ends_and_wrong_first_words() {
    let text = "/// What it is.\n/// It can\n/// not be.\nfn mended() {}\n/// Reads it.\n/// What follows.\n";
    assert_eq!(
        complaints("a.rs", text),
        [
            "a.rs:2: \"can not\": write cannot",
            "a.rs:4: \"mended\": write fixed",
            "a.rs:1: a doc comment begins with \"What\": say what the item is or does",
        ]
    );
    assert_eq!(complaints("a.md", "Not \"whoever\" but a name."), [""; 0]);
}
