//! Spans of a source text, and their replacement.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The position of a character in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub struct SourcePosition {
    /// The number of the line, counted from 1.
    pub line: usize,
    /// The number of the character in the line, counted from 1.
    pub column: usize,
}

/// A span of a text, from one position up to but not including another, such as `38:9-39:44`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct SourceSpan {
    /// The position of the first character.
    pub start: SourcePosition,
    /// The position after the last character.
    pub end: SourcePosition,
}

/// An error returned if a text is not a span.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is not a span: expected lines and columns, such as `38:9-39:44`")]
pub struct SpanError(String);

impl SourceSpan {
    /// Returns `text` with the span replaced by `now`, or `None` if the span is not in the text.
    pub fn replace(self, text: &str, now: &str) -> Option<String> {
        let (start, end) = (byte_offset(text, self.start)?, byte_offset(text, self.end)?);
        (start <= end).then(|| format!("{}{now}{}", &text[..start], &text[end..]))
    }
}

/// Returns the byte offset of a position, or `None` if the position is neither a character of the
/// text nor the end of a line.
fn byte_offset(text: &str, position: SourcePosition) -> Option<usize> {
    let (line, column) = (
        position.line.checked_sub(1)?,
        position.column.checked_sub(1)?,
    );
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
        let position = |text: &str| {
            let (line, column) = text.split_once(':')?;
            let (line, column) = (line.parse().ok()?, column.parse().ok()?);
            Some(SourcePosition { line, column })
        };
        let span = text
            .split_once('-')
            .and_then(|(start, end)| position(start).zip(position(end)));
        span.map(|(start, end)| SourceSpan { start, end })
            .ok_or(SpanError(text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "one\nzwölf · two\nthree\n";

    fn replaced(span: &str, now: &str) -> Option<String> {
        let span: SourceSpan = span.to_owned().try_into().expect("the span is valid");
        span.replace(TEXT, now)
    }

    #[test]
    fn columns_count_characters_and_not_bytes() {
        let now = replaced("2:7-2:8", "+").expect("the span is in the text");
        assert_eq!(now, "one\nzwölf + two\nthree\n");
    }

    #[test]
    fn a_span_may_cross_lines_and_end_at_a_line_end() {
        let now = replaced("1:2-3:6", "()").expect("the span is in the text");
        assert_eq!(now, "o()\n");
        let gone = replaced("1:1-1:2", "").expect("the span is in the text");
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
        let span: SourceSpan = "38:9-39:44"
            .to_owned()
            .try_into()
            .expect("the span is valid");
        assert_eq!(span.to_string(), "38:9-39:44");
        let error = SourceSpan::try_from("38:9".to_owned()).expect_err("the end is missing");
        assert_eq!(error, SpanError("38:9".to_owned()));
    }
}
