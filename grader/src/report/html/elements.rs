//! Renders elements that several parts of the page use, and text by the exam's authors, in which
//! `code` and *emphasis* are marked as in Markdown.

use maud::{Markup, html};

use judging::sanitize::sanitize;

/// Renders untrusted text. Escapes markup, control characters, and characters that would change the
/// direction of the surrounding text.
pub(super) fn plain_text(text: &str) -> Markup {
    html! { (sanitize(text, usize::MAX)) }
}

/// Renders a command to type, with a copy button that the script reveals.
pub(super) fn command(text: &str) -> Markup {
    html! {
        span .command {
            code { (plain_text(text)) }
            button type="button" .copy hidden aria-label=(format!("Copy {}", sanitize(text, 200))) {
                "Copy"
            }
        }
    }
}

/// Renders a table with the rows `asked`, `got` and `wanted`.
pub(super) fn evidence_table(asked: &str, got: &str, wanted: &str) -> Markup {
    html! {
        table .rows {
            tbody {
                @for (label, text) in [("asked", asked), ("got", got), ("wanted", wanted)] {
                    tr {
                        th scope="row" { (label) }
                        td { (plain_text(text)) }
                    }
                }
            }
        }
    }
}

/// Renders text with code and emphasis. Unpaired marks are kept unchanged.
pub fn prose(text: &str) -> Markup {
    html! {
        @for (index, part) in parts(text, '`').into_iter().enumerate() {
            @if index % 2 == 1 {
                code { (plain_text(part)) }
            } @else {
                @for (index, part) in parts(part, '*').into_iter().enumerate() {
                    @if index % 2 == 1 { em { (plain_text(part)) } } @else { (plain_text(part)) }
                }
            }
        }
    }
}

/// Splits text at paired marks, so that every second part is inside a pair. If a mark is
/// unpaired, returns the entire text as one part.
fn parts(text: &str, mark: char) -> Vec<&str> {
    let parts: Vec<&str> = text.split(mark).collect();
    let inside = parts.iter().skip(1).step_by(2);
    let is_paired = parts.len() % 2 == 1
        && inside
            .clone()
            .all(|part| !part.is_empty() && part.trim() == *part);
    if is_paired { parts } else { vec![text] }
}

#[cfg(test)]
mod tests {
    use super::prose;

    #[test]
    fn renders_paired_marks_and_leaves_others_alone() {
        let shown = |text| prose(text).into_string();
        assert_eq!(
            shown("the *last* of `times`, <b>"),
            "the <em>last</em> of <code>times</code>, &lt;b&gt;"
        );
        assert_eq!(shown("2 * tan and 3 * 4"), "2 * tan and 3 * 4");
        assert_eq!(shown("an odd * or ` one"), "an odd * or ` one");
        assert_eq!(shown("`a * b * c`"), "<code>a * b * c</code>");
    }
}
