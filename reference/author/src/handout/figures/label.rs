//! Labels with subscripts.

use grader::svg;
use maud::{Markup, html};

/// Temporary replacement for `__` while single underscores are processed.
const LITERAL: &str = "\u{1}";

/// Returns the text with each letter after a `_` as a subscript.
pub(super) fn with_subscripts(text: &str) -> Markup {
    let text = text.replace("__", LITERAL);
    let mut pieces = text.split('_');
    let plain = |text: &str| svg::text(&text.replace(LITERAL, "_"));
    html! {
        (plain(pieces.next().unwrap_or_default()))
        @for piece in pieces {
            @let (letter, rest) = piece.split_at(piece.ceil_char_boundary(1));
            tspan dy="4" font-size="75%" { (letter) }
            tspan dy="-4" { (plain(rest)) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn renders_subscripts_and_escapes_text() {
        assert_eq!(
            with_subscripts("S_A < 1").into_string(),
            "S<tspan dy=\"4\" font-size=\"75%\">A</tspan><tspan dy=\"-4\"> &lt; 1</tspan>"
        );
        assert_eq!(
            with_subscripts("vertical__fov").into_string(),
            "vertical_fov"
        );
    }
}
