//! Errors of the JSON parser, in the terms of scene files: an object has keys, and a kind of shape
//! or material.

use serde_json::error::Category;
use serde_path_to_error::{Path, Segment};

use super::error::{SceneError, SceneErrorKind, TextPosition};
use super::json_path::{member, offset_of};
use crate::suggestion::suggestion;

/// Converts an error of the parser. `path` is the path of the value that was being parsed.
pub(super) fn scene_error(text: &str, path: &Path, error: &serde_json::Error) -> SceneError {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    let suffix = format!(" at line {line} column {column}");
    let message = message.strip_suffix(&suffix).unwrap_or(&message);
    let (position, message) = match error.classify() {
        Category::Data => {
            let (offset, message) = data_error(text, path, message);
            (Some(TextPosition::at_offset(text, offset)), message)
        }
        // Line 0 means that the parser does not know the position.
        Category::Syntax | Category::Eof | Category::Io => (
            (line > 0).then(|| TextPosition::new(text, line, column)),
            syntax_message(message),
        ),
    };
    SceneError::new(position, SceneErrorKind::Syntax(message))
}

/// Returns the offset of a value or key that is valid JSON, but not valid in a scene, and the message
/// about it.
fn data_error(text: &str, path: &Path, message: &str) -> (usize, String) {
    let value = offset_of(text, path);
    let last_name = path.iter().filter_map(segment_name).next_back();
    // The parser quotes the wrong name first, and then the known ones.
    let (problem, rest) = message.split_once('`').unwrap_or((message, ""));
    let mut quoted = rest.split('`').step_by(2);
    let name = quoted.next().unwrap_or_default();
    let known: Vec<&str> = quoted.collect();
    let key = || {
        let key = format!("{name:?}");
        // The path of an unknown key ends with that key, and so leads to its value.
        let found = match path.iter().next_back().and_then(segment_name) {
            Some(last) if last == name => text[..value].rfind(&key),
            Some(_) | None => text[value..].find(&key).map(|key| value + key),
        };
        found.unwrap_or(value)
    };
    let suggestion = || suggestion(name, &known);
    match problem {
        "missing field " => (value, format!("missing key `{name}`")),
        "duplicate field " => (key(), format!("the key `{name}` occurs twice")),
        "unknown field " => {
            let (known, suggestion) = (known.join(", "), suggestion());
            let message = format!("unknown key `{name}`{suggestion}; the keys here are: {known}");
            (key(), message)
        }
        "unknown variant " => {
            let (kind, known, suggestion) = (kind(path), known.join(", "), suggestion());
            let message =
                format!("there is no {kind} `{name}`{suggestion}; the kinds are: {known}");
            (key(), message)
        }
        // The message names the key itself.
        "" => (
            member(text, value, name).unwrap_or(value),
            message.to_owned(),
        ),
        _ => {
            let message = type_message(message).unwrap_or_else(|| message.to_owned());
            let key = last_name
                .map(|key| format!("`{key}`: "))
                .unwrap_or_default();
            (value, key + &message)
        }
    }
}

/// Returns the name of a part of a path, if it has one.
fn segment_name(segment: &Segment) -> Option<&str> {
    match segment {
        Segment::Map { key: name } | Segment::Enum { variant: name } => Some(name),
        Segment::Seq { .. } | Segment::Unknown => None,
    }
}

/// Returns the term for the objects at a path whose only key is their kind.
fn kind(path: &Path) -> &'static str {
    match path.iter().next() {
        Some(Segment::Map { key }) if key == "materials" => "kind of material",
        Some(Segment::Map { key }) if key == "shapes" => "kind of shape",
        Some(_) | None => "kind",
    }
}

/// Returns the message about a value of the wrong type: what was expected, and what was found.
fn type_message(message: &str) -> Option<String> {
    let (problem, expected) = message.split_once(", expected ")?;
    let got = problem
        .strip_prefix("invalid type: ")
        .or_else(|| problem.strip_prefix("invalid value: "))
        // The parser takes a list for an object if the list is as long as the object.
        .or_else(|| problem.strip_prefix("invalid length ").map(|_| "sequence"))?;
    let got = match got.split_once(' ') {
        _ if got == "map" => "an object".to_owned(),
        _ if got == "sequence" => "a list".to_owned(),
        _ if got.ends_with("variant") => "only a name".to_owned(),
        Some(("integer" | "floating" | "boolean", number)) => {
            number.trim_start_matches("point ").replace('`', "")
        }
        Some(("string", text)) => format!("the text {text}"),
        Some(_) | None => got.to_owned(),
    };
    let expected = match expected {
        "f32" | "f64" => "a number",
        "u32" => "a whole number that is not negative",
        "a string" => "a text in quotes",
        "a sequence" => "a list in [ ]",
        _ if expected.starts_with("struct") || expected.contains("map") => "an object in { }",
        _ if expected.starts_with("enum") || expected.contains("variant") => {
            "an object in { } with one key, its kind"
        }
        other => other,
    };
    Some(format!("expected {expected}, got {got}"))
}

/// Returns the message about a text that is not valid JSON, with what to do.
fn syntax_message(message: &str) -> String {
    let text = match message {
        "EOF while parsing a list" => "the file ends inside a list: a `]` is missing",
        "EOF while parsing an object" => "the file ends inside an object: a `}` is missing",
        "EOF while parsing a string" => "the file ends inside a text: a quote is missing",
        "EOF while parsing a value" => "the file ends where a value should follow",
        "expected value" => {
            "expected a value: a number, a text in quotes, a list in [ ] or an object in { }"
        }
        "expected ident" => "expected a value; `true`, `false` and `null` are written in full",
        "key must be a string" => "expected a key in quotes",
        "trailing comma" => "remove the comma before this closing bracket",
        "trailing characters" => "the scene ends before this: remove the rest",
        "number out of range" => "the number is too large",
        "recursion limit exceeded" => "the lists and objects are nested too deeply",
        _ if message.starts_with("control character") => "the text has no closing quote",
        other => other,
    };
    text.to_owned()
}
