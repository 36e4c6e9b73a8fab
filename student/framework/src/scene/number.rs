//! Parses the numbers in a scene file. They are checked during parsing, so that the parser adds the
//! line and the column to the error.

use glam::{Vec2, Vec3};
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// The largest coordinate, radius or scale. In the formulas for triangles and spheres, the fourth
/// power of a larger number overflows, so that correct code would seem to be wrong.
pub(super) const MAX_COORDINATE: f32 = 1e9;

/// Parses a positive number, such as a radius, a scale or an index of refraction.
pub(super) fn positive<'de, D: Deserializer<'de>>(from: D) -> Result<f32, D::Error> {
    number(from, "a number above 0, up to 1e9", |x| {
        x > 0.0 && x <= MAX_COORDINATE
    })
}

/// Parses a positive number for an optional key.
pub(super) fn optional<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f32>, D::Error> {
    positive(from).map(Some)
}

/// Parses a point or a direction.
pub(super) fn triple<'de, D: Deserializer<'de>>(from: D) -> Result<Vec3, D::Error> {
    numbers(from, "three numbers from -1e9 to 1e9", |x| {
        x.abs() <= MAX_COORDINATE
    })
}

/// Parses a list of points.
pub(super) fn triples<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec3>, D::Error> {
    #[derive(Deserialize)]
    struct Point(#[serde(deserialize_with = "triple")] Vec3);
    let points = Vec::<Point>::deserialize(from)?;
    Ok(points.into_iter().map(|point| point.0).collect())
}

/// Parses an optional list of texture coordinates.
pub(super) fn optional_pairs<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<Option<Vec<Vec2>>, D::Error> {
    #[derive(Deserialize)]
    struct Pair(#[serde(deserialize_with = "pair")] Vec2);
    let pairs = Vec::<Pair>::deserialize(from)?;
    Ok(Some(pairs.into_iter().map(|pair| pair.0).collect()))
}

fn pair<'de, D: Deserializer<'de>>(from: D) -> Result<Vec2, D::Error> {
    list(from, "two finite numbers, u and v", |_| true).map(Vec2::from_array)
}

/// Parses the number of pixels, across and up.
pub(super) fn film<'de, D: Deserializer<'de>>(from: D) -> Result<[u32; 2], D::Error> {
    let given = Vec::<u32>::deserialize(from)?;
    <[u32; 2]>::try_from(given).map_err(|given| {
        D::Error::custom(format!(
            "expected two numbers, the pixels across and up, got {given:?}"
        ))
    })
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
    list(from, expected, is_valid).map(Vec3::from_array)
}

/// Parses a list of `N` numbers. Not as an array: if a list is too long, its error names no length.
fn list<'de, const N: usize, D: Deserializer<'de>>(
    from: D,
    expected: &str,
    is_valid: impl Fn(f32) -> bool,
) -> Result<[f32; N], D::Error> {
    let given = Vec::<f64>::deserialize(from)?;
    let numbers: Vec<f32> = given.iter().map(|&x| x as f32).collect();
    match <[f32; N]>::try_from(numbers) {
        Ok(numbers) if numbers.iter().all(|&x| x.is_finite() && is_valid(x)) => Ok(numbers),
        Ok(_) | Err(_) => Err(D::Error::custom(format!(
            "expected {expected}, got {given:?}"
        ))),
    }
}
