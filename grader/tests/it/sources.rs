//! Rules for the sources themselves: phrases, layers, and things that only one module may do.

use std::fs;
use std::path::Path;

use crate::harness::workspace;

/// A file: its path below the workspace, with `/` as the separator, and its text.
type Source = (String, String);

/// Paths that aren't read: generated files, files written by others, and this file, which quotes
/// the phrases it looks for.
const SKIPPED: [&str; 9] = [
    "target",
    ".git",
    "grader/fuzz/corpus",
    "grader/fuzz/target",
    "grader/tests/browser/axe",
    "grader/tests/it/sources.rs",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "Cargo.lock",
];

/// Returns the files with these extensions below a path.
fn files(path: &str, extensions: &[&str]) -> Vec<Source> {
    let absolute = workspace().join(path);
    if SKIPPED.contains(&path) {
        return Vec::new();
    }
    if absolute.is_dir() && !absolute.is_symlink() {
        let entries = fs::read_dir(&absolute).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
        let below = names.map(|name| format!("{path}/{name}").trim_matches('/').to_owned());
        let mut below: Vec<String> = below.collect();
        below.sort();
        let below = below.iter();
        return below.flat_map(|path| files(path, extensions)).collect();
    }
    let extension = Path::new(path).extension().unwrap_or_default();
    if !extensions.iter().any(|known| extension == *known) {
        return Vec::new();
    }
    let text = fs::read_to_string(&absolute).ok();
    let file = text.map(|text| (path.to_owned(), text));
    file.into_iter().collect()
}

/// Returns the Rust files below these folders.
fn sources(folders: &[&str]) -> Vec<Source> {
    let folders = folders.iter();
    folders.flat_map(|folder| files(folder, &["rs"])).collect()
}

/// Returns the locations of matching lines of code. The tests at the end of each file are excluded.
fn lines_with(sources: &[Source], is_found: impl Fn(&str) -> bool) -> Vec<String> {
    let found = sources.iter().flat_map(|(path, text)| {
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let is_test = path.ends_with("tests.rs") || path.contains("/tests/");
        let lines = (1..).zip(code.lines()).filter(|_| !is_test);
        let code = lines.filter(|(_, line)| !line.trim_start().starts_with("//"));
        let found = code.filter(|(_, line)| is_found(line));
        found
            .map(move |(number, _)| format!("{path}:{number}"))
            .collect::<Vec<_>>()
    });
    found.collect()
}

fn contains_any(line: &str, words: &[&str]) -> bool {
    words.iter().any(|word| line.contains(word))
}

/// Code that only a few files may contain.
struct Rule {
    folders: &'static [&'static str],
    is_found: fn(&str) -> bool,
    /// Files and folders that may contain this code.
    exceptions: &'static [&'static str],
    instead: &'static str,
}

const RULES: [Rule; 4] = [
    // Files are accessed through `grader::disk`, so that tests can make every operation fail.
    Rule {
        folders: &[
            "grader/class/src",
            "grader/src/format",
            "grader/src/policy",
            "grader/src/report",
            "grader/src/submission",
            "grader/src/grade",
        ],
        is_found: is_call_of_std_fs,
        exceptions: &[
            // lists folders after calling `disk::before`, and checks the kind of each entry
            "grader/class/src/file_tree.rs",
            // only check whether the input is a file or a folder, and its size
            "grader/class/src/input.rs",
            "grader/class/src/unpack.rs",
            // only checks whether a new folder is empty
            "grader/class/src/similarity.rs",
            // calls `disk::before` for each step of a write
            "grader/src/report/atomic_write.rs",
            // opens archives after calling `disk::before`, and opens the same file again to read it
            "grader/src/submission/archive/mod.rs",
        ],
        instead: "use grader::files instead",
    },
    // A jump of the wall clock cannot change a grade, because nothing reads the clock.
    Rule {
        folders: &["grader/src", "grader/class/src", "grader/judging/src"],
        is_found: is_call_of_a_clock,
        // compares modification times of the compiler's files
        exceptions: &["grader/src/build/toolchain.rs"],
        instead: "points do not depend on time",
    },
    // Only one type adds a path to a system error.
    Rule {
        folders: &[
            "grader/src",
            "grader/class/src",
            "grader/view/src",
            "reference/author/src",
        ],
        is_found: is_error_of_the_system,
        exceptions: &["grader/src/machine/files.rs"],
        instead: "use grader::files::PathError instead",
    },
    // All programs print in one place.
    Rule {
        folders: &[
            "grader/src",
            "grader/class/src",
            "grader/view/src",
            "grader/judging/src",
        ],
        is_found: |line| contains_any(line, &["print!(", "println!(", "dbg!(", ".exit()"]),
        // The sandbox doesn't print students' text.
        exceptions: &["grader/src/machine/printing.rs", "grader/src/sandbox/"],
        instead: "use grader::printing",
    },
];

fn is_call_of_std_fs(line: &str) -> bool {
    let calls = ["fs::", "File::open", "File::create", "OpenOptions"];
    contains_any(line, &calls) && !line.trim_start().starts_with("use ")
}

fn is_call_of_a_clock(line: &str) -> bool {
    let now = ["SystemTime", "UNIX_EPOCH", "Timestamp::now", "Zoned::now"];
    contains_any(line, &now) || line.contains(".modified()")
}

/// Returns whether a line declares a field for the system's error, or a variant with fields for a
/// path and the system's message.
fn is_error_of_the_system(line: &str) -> bool {
    let field = line.trim().trim_start_matches("pub ").trim_end_matches(',');
    ["Io {", "source: io::Error", "source: std::io::Error"].contains(&field)
}

#[test]
fn only_the_exceptions_have_what_the_rules_forbid() {
    for rule in RULES {
        let mut found = lines_with(&sources(rule.folders), rule.is_found);
        for exception in rule.exceptions {
            let before = found.len();
            found.retain(|place| !place.starts_with(exception));
            assert!(found.len() < before, "{exception} needs no exception");
        }
        assert_eq!(found, [""; 0], "{}", rule.instead);
    }
}

#[test]
fn the_search_finds_lines_of_code_only() {
    let found = |text: &str, is_found: fn(&str) -> bool| {
        let sources = [("a.rs".to_owned(), text.to_owned())];
        lines_with(&sources, is_found)
    };
    let text =
        "use std::fs;\nlet text = fs::read(path);\n// fs::\nFile::open(x)\n#[cfg(test)]\nfs::a()";
    assert_eq!(found(text, is_call_of_std_fs), ["a.rs:2", "a.rs:4"]);
    let text = "Io {\n  pub source: io::Error,";
    assert_eq!(found(text, is_error_of_the_system), ["a.rs:1", "a.rs:2"]);
}

/// Returns the names in backticks in the table of layers.
fn modules_in_order(text: &str) -> Vec<&str> {
    let rows = text.lines().filter(|line| line.starts_with("//! | "));
    let names = rows.flat_map(|row| row.split('`').skip(1).step_by(2));
    names.map(|name| name.trim_start_matches("mod@")).collect()
}

/// Modules only use each other in the order of the table in `src/lib.rs`.
#[test]
fn modules_use_only_those_below_them() {
    let text = fs::read_to_string(workspace().join("grader/src/lib.rs")).unwrap();
    let modules = modules_in_order(&text);
    for line in text.lines().filter(|line| line.contains("mod ")) {
        let name = line.trim_end_matches(';').rsplit(' ').next().unwrap();
        assert!(
            modules.contains(&name) || line.starts_with("//"),
            "{name} is in no layer"
        );
    }
    for (index, module) in modules.iter().enumerate() {
        let path = format!("grader/src/{module}");
        let sources = sources(&[&path, &format!("{path}.rs")]);
        for above in &modules[..index] {
            let uses = [":", ";", ","].map(|end| format!("crate::{above}{end}"));
            let uses = uses.each_ref().map(String::as_str);
            let found = lines_with(&sources, |line| contains_any(line, &uses));
            assert_eq!(found, [""; 0], "{module} uses {above}, which is above it");
        }
    }
}

/// Phrases that are always wrong here (see "Language" in `.github/CONTRIBUTING.md`), each as a list
/// of words with the text to write instead. The other rules in that section are left to reviewers.
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

/// Beginnings of doc comments that don't say what the item is or does.
const FIRST_WORDS: [&str; 5] = ["What ", "Which.", "Where.", "Whoever ", "Said of "];

/// Extensions of files that people read.
const ENDINGS: [&str; 10] = [
    "rs", "md", "toml", "yml", "yaml", "html", "css", "js", "snap", "sh",
];

/// Returns the words of `text` in lower case, each with its 1-based line number. The words of all
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

/// Returns a message for each phrase to avoid and for each doc comment that begins with a wrong
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
    let files = files("", &ENDINGS);
    assert!(files.len() > 500, "{} files", files.len());
    let complaints = files.iter().flat_map(|(name, text)| complaints(name, text));
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
