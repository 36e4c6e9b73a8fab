//! Parallelograms with a material. Rooms are made of them.

use glam::{DVec2, DVec3};
use serde::Deserialize;

use super::flat_shape::FlatShape;
use super::lights::FlatLight64;

/// How a surface scatters or emits light. Scene files describe it in the same way.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Material64 {
    /// A matte surface.
    Lambertian {
        /// The fraction of light that is scattered.
        albedo: DVec3,
    },
    /// A perfect mirror.
    Mirror {
        /// The fraction of light that is reflected.
        reflectance: DVec3,
    },
    /// Glass.
    Glass {
        /// The index of refraction.
        ior: f64,
    },
    /// A light, which scatters nothing.
    Emitter {
        /// The radiance that is emitted from the front.
        radiance: DVec3,
    },
}

/// A parallelogram with a material. Its front is the side from which its corners appear in
/// counterclockwise order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    shape: FlatShape,
    material: Material64,
}

impl Quad {
    /// Creates the parallelogram with the corners p, p + a, p + a + b and p + b, where p is `corner`
    /// and `[a, b]` are the `edges`.
    ///
    /// All numbers are rounded, so that they and their sums are exact in single precision:
    /// coordinates to multiples of a power of two, and all others to single precision.
    pub fn new(corner: DVec3, edges: [DVec3; 2], material: Material64) -> Quad {
        let far_corner = corner + edges[0] + edges[1];
        let extent = corner.abs().max(far_corner.abs()).max_element();
        // Single precision has 24 bits.
        let step = libm::exp2(libm::ceil(libm::log2(extent)) - 22.0);
        let round = |v: DVec3| (v / step).round() * step;
        Quad {
            shape: FlatShape {
                corner: round(corner),
                edges: edges.map(round),
                is_triangle: false,
            },
            material: material.rounded(),
        }
    }

    /// Returns the shape after rounding.
    pub fn shape(&self) -> &FlatShape {
        &self.shape
    }

    /// Returns the material after rounding.
    pub fn material(&self) -> &Material64 {
        &self.material
    }

    /// Returns the corners in the order that scene files list them.
    pub fn corners(&self) -> [DVec3; 4] {
        [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|position| self.shape.at(position))
    }

    /// Returns the two lights that an emitting parallelogram is split into, in scene order, or no
    /// lights for any other material. The diagonal from p to p + a + b separates the triangles.
    pub fn lights(&self) -> Vec<FlatLight64> {
        let Material64::Emitter { radiance } = self.material else {
            return Vec::new();
        };
        let [p, q, r, s] = self.corners();
        let half = |to: [DVec3; 2]| FlatLight64 {
            shape: FlatShape {
                corner: p,
                edges: to.map(|corner| corner - p),
                is_triangle: true,
            },
            radiance,
        };
        vec![half([q, r]), half([r, s])]
    }
}

impl Material64 {
    /// Returns the material with all numbers rounded to single precision.
    fn rounded(mut self) -> Material64 {
        match &mut self {
            Material64::Lambertian { albedo: color }
            | Material64::Mirror { reflectance: color }
            | Material64::Emitter { radiance: color } => *color = rounded(*color),
            Material64::Glass { ior } => *ior = f64::from(*ior as f32),
        }
        self
    }
}

/// Rounds numbers to single precision.
pub(super) fn rounded(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}
