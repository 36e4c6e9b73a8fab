//! Finds the value at a path in a JSON text. The parser itself knows only how far it has read, which
//! for an error in an object is often the closing brace.

use serde::de::IgnoredAny;
use serde_json::{Deserializer, StreamDeserializer};
use serde_path_to_error::{Path, Segment};

/// Returns the offset of the value at `path`, or of the innermost value on the way to it that
/// exists.
pub(super) fn offset_of(text: &str, path: &Path) -> usize {
    path.iter().fold(first_value(text, 0), |start, segment| {
        let child = match segment {
            Segment::Seq { index } => element(text, start, *index),
            Segment::Map { key } => member(text, start, key),
            Segment::Enum { variant } => member(text, start, variant),
            Segment::Unknown => None,
        };
        child.unwrap_or(start)
    })
}

/// Returns the offset of the value of `key` in the object at `start`.
pub(super) fn member(text: &str, start: usize, key: &str) -> Option<usize> {
    let mut next = after(text, start, '{')?;
    loop {
        let (name, end) = read::<String>(text, next)?;
        let value = after(text, end, ':')?;
        if name == key {
            return Some(value);
        }
        let (_, end) = read::<IgnoredAny>(text, value)?;
        next = after(text, end, ',')?;
    }
}

/// Returns the offset of an element of the list at `start`.
fn element(text: &str, start: usize, index: usize) -> Option<usize> {
    let first = after(text, start, '[')?;
    (0..index).try_fold(first, |element, _| {
        let (_, end) = read::<IgnoredAny>(text, element)?;
        after(text, end, ',')
    })
}

/// Reads the value at `start`. Returns it, and the offset of its end.
fn read<'de, T: serde::Deserialize<'de>>(text: &'de str, start: usize) -> Option<(T, usize)> {
    let mut values: StreamDeserializer<_, T> =
        Deserializer::from_str(text.get(start..)?).into_iter();
    let value = values.next()?.ok()?;
    Some((value, start + values.byte_offset()))
}

/// Returns the offset of the first value after a punctuation mark, which must come next.
fn after(text: &str, start: usize, mark: char) -> Option<usize> {
    let mark_start = first_value(text, start);
    let rest = text.get(mark_start..)?.strip_prefix(mark)?;
    Some(first_value(text, text.len() - rest.len()))
}

/// Returns the offset of the first character that is not white space.
fn first_value(text: &str, start: usize) -> usize {
    let rest = text.get(start..).unwrap_or_default();
    text.len() - rest.trim_start().len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str, start: Option<usize>) -> &str {
        start.map_or("nothing", |start| &text[start..])
    }

    #[test]
    fn finds_members_and_elements() {
        let text = r#" { "a" : [1, "x,]}", {"b": 2}] , "c": {} }"#;
        let list = member(text, 1, "a").expect("the object has this key");
        assert!(at(text, Some(list)).starts_with("[1,"));
        assert!(at(text, element(text, list, 1)).starts_with("\"x,]}\""));
        let last = element(text, list, 2).expect("the list has three elements");
        assert_eq!(at(text, member(text, last, "b")), "2}] , \"c\": {} }");
        assert_eq!(at(text, member(text, 1, "c")), "{} }");
        assert_eq!(element(text, list, 3), None);
        assert_eq!(member(text, 1, "d"), None);
        assert_eq!(member(text, list, "a"), None);
    }
}
