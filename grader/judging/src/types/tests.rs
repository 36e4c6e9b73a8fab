//! Properties of every field type that occurs in answers.

use glam::{Vec2, Vec3};
use proptest::prelude::*;
use protocol::{Interval, Value};

use super::{Tolerance, direction, in_units_of, length, of, portion, uv};

/// Generates pairs that consist of a correct value of any type and an arbitrary answer.
fn pair() -> impl Strategy<Value = (Value<'static>, Value<'static>)> {
    let unit = |at: Vec3| at.try_normalize().unwrap_or(Vec3::X);
    let correct = (point(-1e3..1e3), 0.0..1e3_f32);
    let got = (any::<[f32; 3]>().prop_map(Vec3::from), any::<f32>());
    (0..11, correct, got).prop_map(move |(kind, (at, length), (any, number))| match kind {
        0 => (Value::Length(length), Value::Length(number)),
        1 => (Value::Point(at), Value::Point(any)),
        2 => (Value::Direction(unit(at)), Value::Direction(any)),
        3 => (Value::Uv(fraction(at)), Value::Uv(any.truncate())),
        4 => (
            Value::Interval(times(length, 7.0)),
            Value::Interval(times(number, any.x)),
        ),
        5 => (
            Value::Range(times(length, f32::INFINITY)),
            Value::Range(times(number, any.x)),
        ),
        6 => (Value::Color(at), Value::Color(any)),
        7 => (Value::Density(length), Value::Density(number)),
        8 => (
            Value::OptionalDensity(Some(length)),
            Value::OptionalDensity(Some(number)),
        ),
        // Small fractions are compared as if they were larger.
        9 => (Value::Fraction(0.5 + length / 2e3), Value::Fraction(number)),
        _ => (Value::Index(length as u32), Value::Index(number.to_bits())),
    })
}

fn point(range: std::ops::Range<f32>) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(range).prop_map(Vec3::from)
}

/// Returns texture coordinates between 0 and 1.
fn fraction(at: Vec3) -> Vec2 {
    (at.truncate() / 1e3).abs()
}

fn times(min: f32, length: f32) -> Interval {
    Interval {
        min,
        max: min + length,
    }
}

/// Returns the value with an error of this many tolerances, or `None` if the type has no tolerance.
fn spoiled(value: &Value, tolerances: f32, scale: f32) -> Option<Value<'static>> {
    let relative = |at: f32| at + tolerances * portion::TOLERANCE as f32 * at.abs();
    let length = |length: f32| length + tolerances * length::TOLERANCE * length.abs().max(scale);
    Some(match *value {
        Value::Length(correct) => Value::Length(length(correct)),
        Value::Point(at) => Value::Point(at + Vec3::X * tolerances * length::TOLERANCE * scale),
        Value::Direction(at) => {
            let across = at.any_orthonormal_vector();
            Value::Direction(at + across * tolerances * direction::TOLERANCE)
        }
        Value::Uv(at) => Value::Uv(at + Vec2::Y * tolerances * uv::TOLERANCE),
        Value::Interval(times) => Value::Interval(Interval {
            min: length(times.min),
            ..times
        }),
        Value::Color(at) => Value::Color(Vec3::from(at.to_array().map(relative))),
        Value::Density(at) => Value::Density(relative(at)),
        Value::OptionalDensity(at) => Value::OptionalDensity(Some(relative(at?))),
        Value::Fraction(at) => Value::Fraction(relative(at)),
        Value::Index(_)
        | Value::Count(_)
        | Value::Angle(_)
        | Value::Ratio(_)
        | Value::Film(_)
        | Value::Pixel(_)
        | Value::Offset(_)
        | Value::Shapes(_)
        | Value::Nodes(_)
        | Value::Random(_)
        | Value::RandomPair(_)
        | Value::Lights(_)
        | Value::Scene(_)
        | Value::Map(_)
        // Constants, which aren't computed.
        | Value::Range(_) => return None,
    })
}

proptest! {
    #[test]
    fn a_value_has_no_error_itself((correct, _) in pair(), scale in 1e-3..1e3_f32) {
        // A direction is normalised before it is compared.
        prop_assert!(of(&correct).error(&correct, scale) < 1e-3);
    }

    #[test]
    fn the_error_of_any_answer_is_a_number((correct, got) in pair(), scale in 0.0..1e3_f32) {
        prop_assert!(of(&got).error(&correct, scale) >= 0.0);
        prop_assert!(!of(&got).text().is_empty());
    }

    #[test]
    fn a_value_of_another_type_is_wrong((correct, _) in pair(), (_, got) in pair()) {
        if std::mem::discriminant(&correct) != std::mem::discriminant(&got) {
            prop_assert_eq!(of(&got).error(&correct, 1.0), f64::INFINITY);
        }
    }

    #[test]
    fn half_a_tolerance_is_right_and_two_are_wrong((correct, _) in pair(), scale in 1e3..1e4_f32) {
        let error = |tolerances| {
            Some(of(&spoiled(&correct, tolerances, scale)?).error(&correct, scale))
        };
        let tolerance: Option<Tolerance> = of(&correct).tolerance();
        prop_assert_eq!(tolerance.is_some(), error(0.5).is_some());
        prop_assert!(error(0.5).is_none_or(|error| error < 1.0));
        prop_assert!(error(2.0).is_none_or(|error| error > 1.0));
    }

    /// The signatures of known mistakes consist of observed numbers.
    #[test]
    fn values_that_differ_by_two_tolerances_are_observed_as_different(
        (correct, _) in pair(),
        scale in 1e3..1e4_f32,
    ) {
        if let Some(wrong) = spoiled(&correct, 2.0, scale) {
            let observed = [&correct, &wrong].map(|value| of(value).in_tolerances(scale));
            let mut differences = observed[0].iter().zip(&observed[1]).map(|(a, b)| (a - b).abs());
            prop_assert!(differences.any(|difference| difference > 1.0), "{observed:?}");
        }
    }
}

#[test]
fn a_zero_limit_allows_only_a_zero_error() {
    assert_eq!(in_units_of(0.0, 0.0), 0.0);
    assert_eq!(in_units_of(0.0, 1e-30), f64::INFINITY);
}
