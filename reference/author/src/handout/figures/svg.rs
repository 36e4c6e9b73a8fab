//! Formats numbers, paths and text as SVG.

use std::fmt::Write;

use glam::DVec2;

/// Returns the data of a path through all of the points.
pub(super) fn path(points: &[DVec2]) -> String {
    let mut path = String::new();
    for (index, point) in points.iter().enumerate() {
        let command = if index == 0 { 'M' } else { 'L' };
        let (x, y) = (format_number(point.x), format_number(point.y));
        write!(path, "{command}{x} {y}").expect("writing to a String cannot fail");
    }
    path
}

/// Returns the attributes of a circle.
pub(super) fn circle(center: DVec2, radius: f64) -> String {
    let (x, y, r) = (
        format_number(center.x),
        format_number(center.y),
        format_number(radius),
    );
    format!("cx=\"{x}\" cy=\"{y}\" r=\"{r}\"")
}

/// Formats a number with at most one decimal place. This is finer than a pixel, and coarse enough
/// to be the same on every machine.
pub(super) fn format_number(value: f64) -> String {
    let tenths = (value * 10.0).round() as i64;
    let (whole, tenth) = (tenths.abs() / 10, tenths.abs() % 10);
    let sign = if tenths < 0 { "-" } else { "" };
    match tenth {
        0 => format!("{sign}{whole}"),
        _ => format!("{sign}{whole}.{tenth}"),
    }
}

/// Temporary replacement for `__` while single underscores are processed.
const LITERAL: &str = "\u{1}";

/// Returns the text with each letter after a `_` as a subscript.
pub(super) fn with_subscripts(text: &str) -> String {
    let text = text.replace("__", LITERAL);
    let mut pieces = text.split('_');
    let mut lowered = escape(pieces.next().unwrap_or_default());
    for piece in pieces {
        let mut letters = piece.chars();
        let letter = letters.next().map(String::from).unwrap_or_default();
        let rest = escape(letters.as_str());
        write!(
            lowered,
            "<tspan dy=\"4\" font-size=\"75%\">{letter}</tspan><tspan dy=\"-4\">{rest}</tspan>"
        )
        .expect("writing to a String cannot fail");
    }
    lowered.replace(LITERAL, "_")
}

/// Escapes the characters that are special in XML text.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        assert_eq!(
            [3.0, -0.04, -0.25, 12.34].map(format_number),
            ["3", "0", "-0.3", "12.3"]
        );
    }

    #[test]
    fn renders_subscripts_and_escapes_text() {
        assert_eq!(
            with_subscripts("S_A < 1"),
            "S<tspan dy=\"4\" font-size=\"75%\">A</tspan><tspan dy=\"-4\"> &lt; 1</tspan>"
        );
        assert_eq!(with_subscripts("vertical__fov"), "vertical_fov");
    }
}
