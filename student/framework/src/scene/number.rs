//! Numbers in a scene file, each checked where it stands: the parser adds line and column.

use glam::Vec3;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// A radius, a scale, an index of refraction.
pub(super) fn positive<'de, D: Deserializer<'de>>(from: D) -> Result<f32, D::Error> {
    number(from, "a finite number above 0", |x| x > 0.0)
}

/// [`positive`], where it is given.
pub(super) fn optional<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f32>, D::Error> {
    positive(from).map(Some)
}

/// A point or a direction.
pub(super) fn triple<'de, D: Deserializer<'de>>(from: D) -> Result<Vec3, D::Error> {
    numbers(from, "three finite numbers", |_| true)
}

/// Several points.
pub(super) fn triples<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec3>, D::Error> {
    #[derive(Deserialize)]
    struct Point(#[serde(deserialize_with = "triple")] Vec3);
    let points = Vec::<Point>::deserialize(from)?;
    Ok(points.into_iter().map(|point| point.0).collect())
}

/// The share of light, in red, green and blue, that a surface gives back.
pub(super) fn reflectance<'de, D: Deserializer<'de>>(from: D) -> Result<Vec3, D::Error> {
    numbers(from, "red, green and blue, each from 0 to 1", |x| {
        (0.0..=1.0).contains(&x)
    })
}

/// Light, in red, green and blue.
pub(super) fn radiance<'de, D: Deserializer<'de>>(from: D) -> Result<Vec3, D::Error> {
    numbers(from, "red, green and blue, each 0 or more", |x| x >= 0.0)
}

fn number<'de, D: Deserializer<'de>>(
    from: D,
    wanted: &str,
    holds: impl Fn(f32) -> bool,
) -> Result<f32, D::Error> {
    let given = f64::deserialize(from)?;
    // What fits in an f64 may be infinite here.
    let number = given as f32;
    if number.is_finite() && holds(number) {
        Ok(number)
    } else {
        Err(D::Error::custom(format!("{given} is not {wanted}")))
    }
}

fn numbers<'de, D: Deserializer<'de>>(
    from: D,
    wanted: &str,
    holds: impl Fn(f32) -> bool,
) -> Result<Vec3, D::Error> {
    let given = <[f64; 3]>::deserialize(from)?;
    let numbers = given.map(|x| x as f32);
    if numbers.iter().all(|&x| x.is_finite() && holds(x)) {
        Ok(Vec3::from_array(numbers))
    } else {
        Err(D::Error::custom(format!("{given:?} is not {wanted}")))
    }
}
