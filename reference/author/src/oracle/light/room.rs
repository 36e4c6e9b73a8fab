//! Scenes made of parallelograms.

use glam::DVec3;
use judging::drawing_data::PathHit;

use super::WithMargin;
use super::flat_shape::PlaneHit;
use super::frame::Frame64;
use super::light_sources::{Environment64, LightSources64};
use super::lights::Lights64;
use super::quad::{Material64, Quad, rounded};
use crate::oracle::Ray64;

/// Below this relative height, a ray's origin is in the plane of a quad. Rounding in double
/// precision moves it by about 1e-16.
const COPLANAR: f64 = 1e-9;

/// A scene made of parallelograms, and the light from the environment.
#[derive(Clone, Debug)]
pub struct Room {
    quads: Vec<Quad>,
    sources: LightSources64,
}

/// The point on a surface that a ray hits first.
#[derive(Clone, Copy, Debug)]
pub struct Surface64 {
    /// The position in the world.
    pub position: DVec3,
    /// The material.
    pub material: Material64,
    /// The direction to where the ray came from, in the surface's frame.
    pub out: DVec3,
    /// The radiance that the surface itself emits toward where the ray came from.
    pub emitted: DVec3,
    /// The surface's frame. The normal of glass points out of the glass, and that of any other
    /// material is on the side of the ray.
    pub frame: Frame64,
    /// The index of the quad.
    quad: usize,
}

impl Surface64 {
    /// Returns the kind of the surface.
    pub fn kind(&self) -> PathHit {
        match self.material {
            Material64::Lambertian { .. } => PathHit::Matte,
            Material64::Mirror { .. } => PathHit::Mirror,
            Material64::Glass { .. } => PathHit::Glass,
            Material64::Emitter { .. } => PathHit::Light,
        }
    }
}

impl Room {
    /// Creates a room. The quads must not overlap. A constant environment is rounded to single
    /// precision.
    pub fn new(quads: Vec<Quad>, environment: Environment64) -> Room {
        let environment = match environment {
            Environment64::Constant(radiance) => Environment64::Constant(rounded(radiance)),
            Environment64::Map(map) => Environment64::Map(map),
        };
        let lights = Lights64::new(quads.iter().flat_map(Quad::lights));
        Room {
            sources: LightSources64 {
                lights,
                environment,
            },
            quads,
        }
    }

    /// Returns the quads.
    pub fn quads(&self) -> &[Quad] {
        &self.quads
    }

    /// Returns the middle of the room and half of its size along each axis.
    pub fn extent(&self) -> (DVec3, DVec3) {
        let corners = || self.quads.iter().flat_map(Quad::corners);
        let (min, max) = (corners().reduce(DVec3::min), corners().reduce(DVec3::max));
        let (min, max) = (min.unwrap_or_default(), max.unwrap_or_default());
        (0.5 * (min + max), 0.5 * (max - min))
    }

    /// Returns everything that emits light.
    pub fn sources(&self) -> &LightSources64 {
        &self.sources
    }

    /// Returns the surface that a ray hits first. The ray's range is ignored: it starts at its
    /// origin. A ray that leaves a surface skips that surface, `from`.
    ///
    /// The margin is how far the ray is from hitting a different quad first.
    pub fn hit(&self, ray: &Ray64, from: Option<&Surface64>) -> WithMargin<Option<Surface64>> {
        let others = self.quads.iter().enumerate();
        let others = others.filter(|(index, _)| from.is_none_or(|surface| surface.quad != *index));
        let crossings = others.filter_map(|(index, quad)| {
            let hit = quad.shape().intersect_plane(ray.origin, ray.dir)?;
            // Quads in the plane of the surface that the ray leaves can't be hit.
            (from.is_none() || hit.height.abs() > COPLANAR).then_some((index, hit))
        });
        let crossings: Vec<(usize, PlaneHit)> = crossings.collect();
        let hits = crossings.iter().filter(|(_, hit)| hit.is_hit());
        let first = hits.min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance));

        let (first_index, end) = match first {
            Some((index, hit)) => (Some(*index), hit.distance),
            None => (None, f64::INFINITY),
        };
        let margins = crossings.iter().map(|(index, hit)| {
            if Some(*index) == first_index {
                return hit.margin();
            }
            // Behind the first hit, it doesn't matter whether a quad is hit.
            let extent = hit.distance.max(ray.origin.abs().max_element());
            let behind = (hit.distance - end) / extent;
            if hit.is_hit() {
                behind
            } else {
                hit.margin().max(behind)
            }
        });
        WithMargin {
            margin: margins.fold(f64::INFINITY, f64::min),
            value: first.map(|(index, hit)| self.surface(*index, hit, ray)),
        }
    }

    /// Describes a hit of a ray on a quad.
    fn surface(&self, index: usize, hit: &PlaneHit, ray: &Ray64) -> Surface64 {
        let (shape, material) = (self.quads[index].shape(), *self.quads[index].material());
        let is_front = hit.cosine < 0.0;
        let (is_turned, emitted) = match material {
            Material64::Emitter { radiance } if is_front => (false, radiance),
            Material64::Glass { .. } => (false, DVec3::ZERO),
            Material64::Emitter { .. }
            | Material64::Lambertian { .. }
            | Material64::Mirror { .. } => (!is_front, DVec3::ZERO),
        };
        let normal = shape.normal();
        let frame = Frame64::around(if is_turned { -normal } else { normal });
        Surface64 {
            position: ray.at(hit.distance),
            material,
            out: frame.to_local(-ray.dir.normalize()),
            emitted,
            frame,
            quad: index,
        }
    }
}
