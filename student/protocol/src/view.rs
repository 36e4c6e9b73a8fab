use glam::{UVec2, Vec2, Vec3, vec2};
use serde::{Deserialize, Serialize};

use crate::ray::Ray;

/// The parameters for creating a submission's `Camera`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PinholeCamera {
    /// The full vertical field of view, in degrees.
    pub vertical_fov: f32,
    /// The width of the sensor divided by its height. It is independent of `film`.
    pub aspect_ratio: f32,
    /// The width and height of the film, in pixels.
    pub film: UVec2,
}

/// A position on the film: a pixel, and the position within it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// The pixel. (0, 0) is at the bottom left.
    pub pixel: UVec2,
    /// The position in the pixel, each component in `[0, 1)`.
    pub offset: Vec2,
}

impl Sample {
    /// Returns the sample at this index in the order of [`every_pixel`].
    pub(crate) fn of_position(film: UVec2, index: usize) -> Self {
        let (pixel, offset) = (index / PIXEL_OFFSETS.len(), index % PIXEL_OFFSETS.len());
        let width = film.x as usize;
        Sample {
            pixel: UVec2::new((pixel % width) as u32, (pixel / width) as u32),
            offset: PIXEL_OFFSETS[offset],
        }
    }
}

/// The five positions in every pixel at which deterministic pictures are compared.
pub const PIXEL_OFFSETS: [Vec2; 5] = [
    vec2(0.5, 0.5),
    vec2(0.375, 0.125),
    vec2(0.875, 0.375),
    vec2(0.125, 0.625),
    vec2(0.625, 0.875),
];

/// Returns the [`PIXEL_OFFSETS`] in every pixel of a film, row by row from the bottom.
pub fn every_pixel(film: UVec2) -> impl Iterator<Item = Sample> {
    (0..film.y)
        .flat_map(move |y| (0..film.x).map(move |x| UVec2::new(x, y)))
        .flat_map(|pixel| PIXEL_OFFSETS.map(|offset| Sample { pixel, offset }))
}

/// A pinhole camera defined by the exam, so that a picture of shapes doesn't depend on the
/// submission's camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExamCamera {
    /// The origin of every ray.
    pub eye: Vec3,
    /// The vector from the eye to the centre of the film.
    pub forward: Vec3,
    /// The vector from the centre of the film to the centre of its right edge.
    pub right: Vec3,
    /// The vector from the centre of the film to the centre of its upper edge.
    pub up: Vec3,
    /// The width and height of the film, in pixels.
    pub film: UVec2,
}

impl ExamCamera {
    /// Returns the ray through a position on the film, with range `[0, ∞)`. The offset may be
    /// outside `[0, 1)`.
    pub fn ray(&self, sample: Sample) -> Ray {
        let position = (sample.pixel.as_vec2() + sample.offset) / self.film.as_vec2() * 2.0 - 1.0;
        Ray::new(
            self.eye,
            self.forward + self.right * position.x + self.up * position.y,
        )
    }
}
