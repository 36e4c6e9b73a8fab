//! A place in a source text, and another text put there.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A character of a text: its line and its column, both from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub struct Place {
    /// Which line.
    pub line: usize,
    /// Which character of it.
    pub column: usize,
}

/// From one character up to, and without, another: `38:9-39:44`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Span {
    /// The first character.
    pub start: Place,
    /// The one after the last.
    pub end: Place,
}

/// The text is no span.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no span: lines and columns are meant, as in `38:9-39:44`")]
pub struct NoSpan(String);

impl Span {
    /// `text` with `now` in the place of what stands there; none if the text has no such place.
    pub fn replace(self, text: &str, now: &str) -> Option<String> {
        let (start, end) = (offset(text, self.start)?, offset(text, self.end)?);
        (start <= end).then(|| format!("{}{now}{}", &text[..start], &text[end..]))
    }
}

/// How many bytes stand before a place, which is a character of the text or the end of a line.
fn offset(text: &str, place: Place) -> Option<usize> {
    let (line, column) = (place.line.checked_sub(1)?, place.column.checked_sub(1)?);
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let line = text.split('\n').nth(line)?;
    let ends = line.char_indices().map(|(at, _)| at).chain([line.len()]);
    Some(start + ends.into_iter().nth(column)?)
}

impl fmt::Display for Span {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Span { start, end } = self;
        write!(
            f,
            "{}:{}-{}:{}",
            start.line, start.column, end.line, end.column
        )
    }
}

impl From<Span> for String {
    fn from(span: Span) -> String {
        span.to_string()
    }
}

impl TryFrom<String> for Span {
    type Error = NoSpan;

    fn try_from(text: String) -> Result<Self, NoSpan> {
        let place = |text: &str| {
            let (line, column) = text.split_once(':')?;
            let (line, column) = (line.parse().ok()?, column.parse().ok()?);
            Some(Place { line, column })
        };
        let span = text
            .split_once('-')
            .and_then(|(start, end)| place(start).zip(place(end)));
        span.map(|(start, end)| Span { start, end })
            .ok_or(NoSpan(text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "one\nzwölf · two\nthree\n";

    fn replaced(span: &str, now: &str) -> Option<String> {
        let span: Span = span.to_owned().try_into().expect("a span");
        span.replace(TEXT, now)
    }

    #[test]
    fn columns_count_characters_and_not_bytes() {
        let now = replaced("2:7-2:8", "+").expect("it is there");
        assert_eq!(now, "one\nzwölf + two\nthree\n");
    }

    #[test]
    fn a_span_may_go_over_lines_and_up_to_the_end_of_one() {
        let now = replaced("1:2-3:6", "()").expect("it is there");
        assert_eq!(now, "o()\n");
        let gone = replaced("1:1-1:2", "").expect("it is there");
        assert_eq!(gone, "ne\nzwölf · two\nthree\n");
    }

    #[test]
    fn what_is_not_there_is_not_replaced() {
        for span in ["1:2-1:5", "9:1-9:2", "0:1-1:1", "1:0-1:1", "2:1-1:1"] {
            assert_eq!(replaced(span, "x"), None, "{span}");
        }
    }

    #[test]
    fn a_span_is_written_as_it_is_read() {
        let span: Span = "38:9-39:44".to_owned().try_into().expect("a span");
        assert_eq!(span.to_string(), "38:9-39:44");
        let error = Span::try_from("38:9".to_owned()).expect_err("half a span");
        assert_eq!(error, NoSpan("38:9".to_owned()));
    }
}
