//! Text by the exam's authors, with `code` and *emphasis* marked as in Markdown.

use maud::{Markup, html};

use super::elements::plain_text;

/// Renders a text with code and emphasis. Unpaired marks are kept unchanged.
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

/// Splits a text at paired marks, so that every second part is inside a pair. If a mark is
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
