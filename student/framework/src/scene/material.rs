//! What surfaces are made of.

use glam::{Vec2, Vec3};
use serde::Deserialize;

use super::number;

/// What a surface does with light.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Material {
    /// Matte on both sides: scatters evenly in all directions.
    Lambertian {
        /// The share of light that is scattered.
        #[serde(deserialize_with = "number::reflectance")]
        albedo: Vec3,
    },
    /// Matte on both sides, with a chessboard of two albedos.
    Checker {
        /// The albedo of the square at u = v = 0.
        #[serde(deserialize_with = "number::reflectance")]
        a: Vec3,
        /// The albedo of its neighbours.
        #[serde(deserialize_with = "number::reflectance")]
        b: Vec3,
        /// How many squares there are from u = 0 to u = 1, and likewise along v.
        #[serde(deserialize_with = "number::positive")]
        scale: f32,
    },
    /// A perfect mirror on both sides.
    Mirror {
        /// The share of light that is reflected.
        #[serde(deserialize_with = "number::reflectance")]
        reflectance: Vec3,
    },
    /// Clear glass; the normal points out of it.
    Glass {
        /// The index of refraction inside; outside it is 1.
        #[serde(deserialize_with = "number::positive")]
        ior: f32,
    },
    /// A lamp: shines evenly from the side that the normal points to, and reflects nothing.
    Emitter {
        /// The radiance that leaves it.
        #[serde(deserialize_with = "number::radiance")]
        radiance: Vec3,
    },
}

impl Material {
    /// The radiance that leaves the surface on its own.
    pub fn emitted(&self) -> Option<Vec3> {
        match *self {
            Material::Emitter { radiance } => Some(radiance),
            Material::Lambertian { .. }
            | Material::Checker { .. }
            | Material::Mirror { .. }
            | Material::Glass { .. } => None,
        }
    }
}

/// Which of a chessboard's two albedos is at `uv`.
pub(crate) fn checker(a: Vec3, b: Vec3, scale: f32, uv: Vec2) -> Vec3 {
    let square = (uv * scale).floor();
    // In floats: far from zero the sum of two integers would overflow.
    let odd = (square.x + square.y).rem_euclid(2.0);
    if odd == 0.0 { a } else { b }
}

#[cfg(test)]
mod tests {
    use glam::vec2;

    use super::*;

    #[test]
    fn neighbouring_squares_differ_also_below_zero() {
        let at = |u, v| checker(Vec3::ZERO, Vec3::ONE, 2.0, vec2(u, v));
        assert_eq!(at(0.1, 0.1), Vec3::ZERO);
        assert_eq!(at(0.6, 0.1), Vec3::ONE);
        assert_eq!(at(0.6, 0.6), Vec3::ZERO);
        assert_eq!(at(-0.1, 0.1), Vec3::ONE);
        assert_eq!(at(-0.1, -0.1), Vec3::ZERO);
    }
}
