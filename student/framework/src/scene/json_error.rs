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
    let position = match error.classify() {
        Category::Data => Some(TextPosition::at_offset(
            text,
            value_offset(text, path, message),
        )),
        // Line 0 means that the parser does not know the position.
        Category::Syntax | Category::Eof | Category::Io => {
            (line > 0).then(|| TextPosition::new(text, line, column))
        }
    };
    let message = match error.classify() {
        Category::Data => data_message(message, path),
        Category::Syntax | Category::Eof | Category::Io => syntax_message(message),
    };
    SceneError::new(position, SceneErrorKind::Syntax(message))
}

/// Returns the offset of the value or key that is wrong.
fn value_offset(text: &str, path: &Path, message: &str) -> usize {
    let start = offset_of(text, path);
    let Some(name) = message.split('`').nth(1) else {
        return start;
    };
    if message.starts_with('`') {
        return member(text, start, name).unwrap_or(start);
    }
    let is_about_a_key = ["unknown field ", "unknown variant ", "duplicate field "]
        .iter()
        .any(|term| message.starts_with(term));
    if !is_about_a_key {
        return start;
    }
    let key = format!("{name:?}");
    // The path of an unknown key ends with that key, and so leads to its value.
    let is_of_value = path.iter().next_back().and_then(segment_name) == Some(name);
    let key_start = if is_of_value {
        text[..start].rfind(&key)
    } else {
        text[start..].find(&key).map(|key| start + key)
    };
    key_start.unwrap_or(start)
}

/// Returns the message about a value that is valid JSON, but not valid in a scene.
fn data_message(message: &str, path: &Path) -> String {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    if let Some(rest) = message.strip_prefix("missing field ") {
        return format!("missing key {rest}");
    }
    if let Some(rest) = message.strip_prefix("duplicate field ") {
        return format!("the key {rest} occurs twice");
    }
    if let (true, [name, known @ ..]) = (message.starts_with("unknown field "), &quoted[..]) {
        let known_keys = known.join(", ");
        return format!(
            "unknown key `{name}`{}; the keys here are: {known_keys}",
            suggestion(name, known)
        );
    }
    if let (true, [name, known @ ..]) = (message.starts_with("unknown variant "), &quoted[..]) {
        return format!(
            "there is no {} `{name}`{}; the kinds are: {}",
            kind(path),
            suggestion(name, known),
            known.join(", ")
        );
    }
    let text = type_message(message).unwrap_or_else(|| message.to_owned());
    match path.iter().filter_map(segment_name).next_back() {
        Some(key) if !text.starts_with('`') => format!("`{key}`: {text}"),
        Some(_) | None => text,
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
