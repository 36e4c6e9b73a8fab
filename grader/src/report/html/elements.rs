//! Elements that several parts of the page use.

use maud::{Markup, html};

use judging::sanitize::sanitize;

/// Renders untrusted text, escaped and without control characters or characters that change the
/// direction of the text around it.
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
