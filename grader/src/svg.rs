//! Formats numbers, paths and text for SVG images.
//!
//! The elements are written as `maud` markup, which escapes text. The markup doesn't support
//! `<path/>`, so an element without contents is written `path d=(…) {}`. With a `;` instead of the
//! braces, the element wouldn't be closed, which is invalid XML.

use std::fmt::Write;

use glam::DVec2;

/// Formats a number with at most one decimal place. That is more precise than a pixel and gives
/// the same text on every machine.
pub fn number(value: f64) -> String {
    let tenths = (value * 10.0).round() as i64;
    let (whole, tenth) = (tenths.abs() / 10, tenths.abs() % 10);
    let sign = if tenths < 0 { "-" } else { "" };
    match tenth {
        0 => format!("{sign}{whole}"),
        _ => format!("{sign}{whole}.{tenth}"),
    }
}

/// Returns the data of an open path through the points.
pub fn path(points: &[DVec2]) -> String {
    let mut path = String::new();
    for (index, point) in points.iter().enumerate() {
        let command = if index == 0 { 'M' } else { 'L' };
        let (x, y) = (number(point.x), number(point.y));
        write!(path, "{command}{x} {y}").expect("writing to a String cannot fail");
    }
    path
}

/// Returns the data of a closed path through the points.
pub fn closed_path(points: &[DVec2]) -> String {
    path(points) + "Z"
}

/// Replaces the control characters in text. XML doesn't allow them, even if they are escaped.
pub fn text(text: &str) -> String {
    text.replace(char::is_control, "\u{fffd}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        assert_eq!(
            [3.0, -0.04, -0.25, 12.34].map(number),
            ["3", "0", "-0.3", "12.3"]
        );
    }
}
