//! Materials of surfaces.

use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

use super::error::SceneError;
use super::value::Value;

/// How a surface scatters or emits light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Material {
    /// A surface that is matte on both sides and reflects the same radiance in all directions.
    Lambertian {
        /// The fraction of light that is scattered, for each colour channel.
        albedo: Vec3,
    },
    /// A surface that is matte on both sides, with a chequerboard of two albedos.
    Checker {
        /// The albedo of the square at u = v = 0.
        a: Vec3,
        /// The albedo of the neighbouring squares.
        b: Vec3,
        /// The number of squares from u = 0 to u = 1, and also from v = 0 to v = 1.
        scale: f32,
    },
    /// A surface that is a perfect mirror on both sides.
    Mirror {
        /// The fraction of light that is reflected, for each colour channel.
        reflectance: Vec3,
    },
    /// Clear glass. The normal points out of the glass.
    Glass {
        /// The index of refraction of the glass. Outside, it is 1.
        ior: f32,
    },
    /// A light. It emits the same radiance in all directions on the side of the normal and reflects
    /// nothing.
    Emitter {
        /// The emitted radiance.
        radiance: Vec3,
    },
}

const KINDS: [&str; 5] = ["lambertian", "checker", "mirror", "glass", "emitter"];

impl Material {
    /// Reads an entry of `materials` in a scene file.
    pub(super) fn read(value: &Value) -> Result<Material, SceneError> {
        let (kind, value) = value.kind()?;
        Ok(match kind.key.as_str() {
            "lambertian" => Material::Lambertian {
                albedo: value
                    .object(&["albedo"])?
                    .required("albedo", Value::reflectance)?,
            },
            "checker" => {
                let keys = value.object(&["a", "b", "scale"])?;
                Material::Checker {
                    a: keys.required("a", Value::reflectance)?,
                    b: keys.required("b", Value::reflectance)?,
                    scale: keys.required("scale", Value::positive)?,
                }
            }
            "mirror" => {
                let keys = value.object(&["reflectance"])?;
                let reflectance = keys.required("reflectance", Value::reflectance)?;
                Material::Mirror { reflectance }
            }
            "glass" => Material::Glass {
                ior: value.object(&["ior"])?.required("ior", Value::positive)?,
            },
            "emitter" => Material::Emitter {
                radiance: value
                    .object(&["radiance"])?
                    .required("radiance", Value::radiance)?,
            },
            name => {
                let problem = "unknown kind of material";
                return Err(kind.unknown(problem, name, ("the kinds are", &KINDS)));
            }
        })
    }

    /// Returns the radiance that the surface emits, or `None` if it isn't an emitter.
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

/// Returns the albedo of a chequerboard at `uv`.
pub fn checker(a: Vec3, b: Vec3, scale: f32, uv: Vec2) -> Vec3 {
    let square = (uv * scale).floor();
    // Use floats, because far from zero the sum of two integers would overflow.
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
