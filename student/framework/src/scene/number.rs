//! Parses the numbers in a scene file. They are checked during parsing, so that the parser adds the
//! line and the column to the error.

use glam::Vec3;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// Parses a positive number, such as a radius, a scale or an index of refraction.
pub(super) fn positive<'de, D: Deserializer<'de>>(from: D) -> Result<f32, D::Error> {
    number(from, "a finite number above 0", |x| x > 0.0)
}

/// Parses a positive number for an optional key.
pub(super) fn optional<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f32>, D::Error> {
    positive(from).map(Some)
}

/// Parses a point or a direction.
pub(super) fn triple<'de, D: Deserializer<'de>>(from: D) -> Result<Vec3, D::Error> {
    numbers(from, "three finite numbers", |_| true)
}

/// Parses a list of points.
pub(super) fn triples<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec3>, D::Error> {
    #[derive(Deserialize)]
    struct Point(#[serde(deserialize_with = "triple")] Vec3);
    let points = Vec::<Point>::deserialize(from)?;
    Ok(points.into_iter().map(|point| point.0).collect())
}

/// Parses an RGB reflectance: the fraction of the light that a surface reflects.
pub(super) fn reflectance<'de, D: Deserializer<'de>>(from: D) -> Result<Vec3, D::Error> {
    numbers(from, "red, green and blue, each from 0 to 1", |x| {
        (0.0..=1.0).contains(&x)
    })
}

/// Parses an RGB radiance.
pub(super) fn radiance<'de, D: Deserializer<'de>>(from: D) -> Result<Vec3, D::Error> {
    numbers(from, "red, green and blue, each 0 or more", |x| x >= 0.0)
}

fn number<'de, D: Deserializer<'de>>(
    from: D,
    expected: &str,
    is_valid: impl Fn(f32) -> bool,
) -> Result<f32, D::Error> {
    let given = f64::deserialize(from)?;
    // A number that fits into an f64 can become infinite as an f32.
    let number = given as f32;
    if number.is_finite() && is_valid(number) {
        Ok(number)
    } else {
        Err(D::Error::custom(format!(
            "expected {expected}, got {given}"
        )))
    }
}

fn numbers<'de, D: Deserializer<'de>>(
    from: D,
    expected: &str,
    is_valid: impl Fn(f32) -> bool,
) -> Result<Vec3, D::Error> {
    let given = <[f64; 3]>::deserialize(from)?;
    let numbers = given.map(|x| x as f32);
    if numbers.iter().all(|&x| x.is_finite() && is_valid(x)) {
        Ok(Vec3::from_array(numbers))
    } else {
        Err(D::Error::custom(format!(
            "expected {expected}, got {given:?}"
        )))
    }
}
