//! Errors as multiples of a tolerance. No result is NaN: the error of values that cannot be compared is
//! infinite.

/// Returns `error` as a multiple of `limit`.
pub(crate) fn in_units_of(limit: f64, error: f64) -> f64 {
    // An error of 0 is accepted even if the limit is 0.
    if error <= 0.0 {
        return 0.0;
    }
    let multiple = error / limit;
    if multiple.is_nan() {
        f64::INFINITY
    } else {
        multiple
    }
}

#[cfg(test)]
mod tests {
    use super::in_units_of;

    #[test]
    fn a_zero_limit_allows_only_a_zero_error() {
        assert_eq!(in_units_of(0.0, 0.0), 0.0);
        assert_eq!(in_units_of(0.0, 1e-30), f64::INFINITY);
    }
}
