//! Numbers, paths and words, as SVG writes them.

use std::fmt::Write;

use glam::DVec2;

/// A path through all of the points.
pub(super) fn path(points: &[DVec2]) -> String {
    let mut path = String::new();
    for (place, point) in points.iter().enumerate() {
        let to = if place == 0 { 'M' } else { 'L' };
        let (x, y) = (format_number(point.x), format_number(point.y));
        write!(path, "{to}{x} {y}").expect("text takes text");
    }
    path
}

/// The attributes of a circle.
pub(super) fn circle(center: DVec2, radius: f64) -> String {
    let (x, y, r) = (
        format_number(center.x),
        format_number(center.y),
        format_number(radius),
    );
    format!("cx=\"{x}\" cy=\"{y}\" r=\"{r}\"")
}

/// A number with at most one digit behind the point: less than a pixel, and the same
/// on every machine.
pub(super) fn format_number(value: f64) -> String {
    let tenths = (value * 10.0).round() as i64;
    let (whole, tenth) = (tenths.abs() / 10, tenths.abs() % 10);
    let sign = if tenths < 0 { "-" } else { "" };
    match tenth {
        0 => format!("{sign}{whole}"),
        _ => format!("{sign}{whole}.{tenth}"),
    }
}

/// Stands for a `__` while single ones are looked for.
const LITERAL: &str = "\u{1}";

/// With each letter behind a `_` below the line.
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
        .expect("text takes text");
    }
    lowered.replace(LITERAL, "_")
}

/// Text that can not end an element.
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
