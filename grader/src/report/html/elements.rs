//! What others have written.

use maud::{Markup, html};

use crate::sanitize::sanitize;

/// The text as text: escaped, without control characters, and without power over the direction of
/// what stands around it.
pub(super) fn plain_text(text: &str) -> Markup {
    html! { (sanitize(text, usize::MAX)) }
}

/// A command to type, with room for a button that copies it.
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

/// A table of three rows: what was asked, what came, what is right.
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
