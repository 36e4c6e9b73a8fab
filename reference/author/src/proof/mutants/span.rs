//! A place in a source text, and another text put there.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A character of a text: its line and its column, both from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub struct SourcePosition {
    /// Which line.
    pub line: usize,
    /// Which character of it.
    pub column: usize,
}

/// From one character up to, and without, another: `38:9-39:44`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct SourceSpan {
    /// The first character.
    pub start: SourcePosition,
    /// The one after the last.
    pub end: SourcePosition,
}

/// The text is no span.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no span: lines and columns are meant, as in `38:9-39:44`")]
pub struct SpanError(String);

impl SourceSpan {
    /// `text` with `now` in the place of what stands there; none if the text has no such place.
    pub fn replace(self, text: &str, now: &str) -> Option<String> {
        let (start, end) = (byte_offset(text, self.start)?, byte_offset(text, self.end)?);
        (start <= end).then(|| format!("{}{now}{}", &text[..start], &text[end..]))
    }
}

/// How many bytes stand before a place, which is a character of the text or the end of a line.
fn byte_offset(text: &str, place: SourcePosition) -> Option<usize> {
    let (line, column) = (place.line.checked_sub(1)?, place.column.checked_sub(1)?);
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let line = text.split('\n').nth(line)?;
    let ends = line.char_indices().map(|(at, _)| at).chain([line.len()]);
    Some(start + ends.into_iter().nth(column)?)
}

impl fmt::Display for SourceSpan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let SourceSpan { start, end } = self;
        write!(
            f,
            "{}:{}-{}:{}",
            start.line, start.column, end.line, end.column
        )
    }
}

impl From<SourceSpan> for String {
    fn from(span: SourceSpan) -> String {
        span.to_string()
    }
}

impl TryFrom<String> for SourceSpan {
    type Error = SpanError;

    fn try_from(text: String) -> Result<Self, SpanError> {
        let place = |text: &str| {
            let (line, column) = text.split_once(':')?;
            let (line, column) = (line.parse().ok()?, column.parse().ok()?);
            Some(SourcePosition { line, column })
        };
        let span = text
            .split_once('-')
            .and_then(|(start, end)| place(start).zip(place(end)));
        span.map(|(start, end)| SourceSpan { start, end })
            .ok_or(SpanError(text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "one\nzwölf · two\nthree\n";

    fn replaced(span: &str, now: &str) -> Option<String> {
        let span: SourceSpan = span.to_owned().try_into().expect("a span");
        span.replace(TEXT, now)
    }

    #[test]
    fn columns_count_characters_and_not_bytes() {
        let now = replaced("2:7-2:8", "+").expect("it is there");
        assert_eq!(now, "one\nzwölf + two\nthree\n");
    }

    #[test]
    fn a_span_may_cross_lines_and_end_at_a_line_end() {
        let now = replaced("1:2-3:6", "()").expect("it is there");
        assert_eq!(now, "o()\n");
        let gone = replaced("1:1-1:2", "").expect("it is there");
        assert_eq!(gone, "ne\nzwölf · two\nthree\n");
    }

    #[test]
    fn positions_outside_the_text_are_rejected() {
        for span in ["1:2-1:5", "9:1-9:2", "0:1-1:1", "1:0-1:1", "2:1-1:1"] {
            assert_eq!(replaced(span, "x"), None, "{span}");
        }
    }

    #[test]
    fn a_span_is_displayed_as_it_is_parsed() {
        let span: SourceSpan = "38:9-39:44".to_owned().try_into().expect("a span");
        assert_eq!(span.to_string(), "38:9-39:44");
        let error = SourceSpan::try_from("38:9".to_owned()).expect_err("half a span");
        assert_eq!(error, SpanError("38:9".to_owned()));
    }
}
