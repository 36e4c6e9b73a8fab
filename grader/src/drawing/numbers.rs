//! Formatting of numbers and of differences between directions.

use glam::{DVec3, Vec3};
use judging::describe;

/// Formats a number with at most four significant digits, for use where six don't fit.
pub(super) fn short(value: f64) -> String {
    if value.is_nan() {
        return "NaN".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞" } else { "-∞" }.to_owned();
    }
    let magnitude = value.abs().max(1e-300).log10().floor();
    if value != 0.0 && !(-4.0..6.0).contains(&magnitude) {
        return format!("{value:.2e}");
    }
    let decimals = (3.0 - magnitude).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    if text == "-0" { "0" } else { text }.to_owned()
}

/// Formats a vector with at most four significant digits per component.
pub(super) fn point(value: DVec3) -> String {
    let [x, y, z] = value.to_array().map(short);
    format!("({x}, {y}, {z})")
}

/// Returns a sentence that says what is wrong with a direction. `name` is what the direction is
/// called, and `wanted` has length one.
pub(super) fn direction_difference(name: &str, wanted: Vec3, got: Vec3) -> String {
    let (wanted, direction) = (wanted.as_dvec3(), got.as_dvec3());
    let length = direction.length();
    if !(length.is_finite() && length > 0.0) {
        return format!("Your {name} {} is not a direction.", describe::point(got));
    }
    let degrees = direction.angle_between(wanted).to_degrees();
    match degrees {
        _ if degrees > 179.5 => format!("Your {name} points in the opposite direction."),
        _ if degrees > 0.05 => format!("Your {name} is off by {}°.", short(degrees)),
        _ => format!(
            "Your {name} has length {}; it must be 1.",
            describe::number(length as f32)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_to_four_significant_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (12.3456, "12.35"),
            (1234.56, "1235"),
            (0.012345, "0.01235"),
            (-2.5, "-2.5"),
            (1e38, "1.00e38"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-∞"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
