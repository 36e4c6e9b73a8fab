//! Numbers as text.

/// Formats a number with six significant digits and no trailing zeros.
pub fn number(value: f32) -> String {
    if value == 0.0 || !value.is_finite() {
        return match value {
            _ if value.is_nan() => "NaN".to_owned(),
            _ if value == f32::INFINITY => "∞".to_owned(),
            _ if value == f32::NEG_INFINITY => "-∞".to_owned(),
            _ => "0".to_owned(),
        };
    }
    let magnitude = value.abs().log10().floor();
    if !(-5.0..7.0).contains(&magnitude) {
        return format!("{value:.5e}");
    }
    let decimals = (5.0 - magnitude).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Formats a random number in `[0, 1)`. A number just below 1 isn't rounded to 1.
pub(super) fn random(value: f32) -> String {
    if (0.999_999..1.0).contains(&value) {
        value.to_string()
    } else {
        number(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_random_number_is_never_printed_as_one() {
        for (value, text) in [
            (0.5, "0.5"),
            (0.999_999_6, "0.9999996"),
            (1.0_f32.next_down(), "0.99999994"),
        ] {
            assert_eq!(random(value), text);
        }
    }

    #[test]
    fn prints_six_significant_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (0.1, "0.1"),
            (1234.5678, "1234.57"),
            (100.0, "100"),
            (-0.000123456, "-0.000123456"),
            (1e20, "1.00000e20"),
            (1e-12, "1.00000e-12"),
            (f32::NAN, "NaN"),
            (f32::NEG_INFINITY, "-∞"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
