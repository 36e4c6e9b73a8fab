use glam::{UVec2, Vec2, Vec3, vec2};
use serde::{Deserialize, Serialize};

use crate::packed;
use crate::ray::Ray;

/// What `Camera::sample_ray` needs to know of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PinholeCamera {
    /// The full opening angle from bottom to top, in degrees.
    pub vertical_fov: f32,
    /// The sensor's width divided by its height; independent of `film`.
    pub aspect_ratio: f32,
    /// The number of pixels, across and up.
    pub film: UVec2,
}

/// One place on the film: a pixel, and the place in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// The pixel; (0, 0) is at the bottom left.
    pub pixel: UVec2,
    /// The place in the pixel, each component in `[0, 1)`.
    pub offset: Vec2,
}

/// The five places of every pixel at which deterministic pictures are compared.
pub const PIXEL_OFFSETS: [Vec2; 5] = [
    vec2(0.5, 0.5),
    vec2(0.375, 0.125),
    vec2(0.875, 0.375),
    vec2(0.125, 0.625),
    vec2(0.625, 0.875),
];

/// The places on the film that a question asks about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Samples {
    /// These places.
    List(Vec<Sample>),
    /// The five [`OFFSETS`] of each pixel, row by row from the bottom.
    EveryPixel,
}

impl Samples {
    /// Every place, in order.
    pub fn to_vec(&self, film: UVec2) -> Vec<Sample> {
        match self {
            Samples::List(list) => list.clone(),
            Samples::EveryPixel => every_pixel(film).collect(),
        }
    }

    /// How many places there are on this film.
    pub fn count(&self, film: UVec2) -> usize {
        match self {
            Samples::List(list) => list.len(),
            // As many as there can be, where there are too many to be counted.
            Samples::EveryPixel => (film.x as usize)
                .saturating_mul(film.y as usize)
                .saturating_mul(PIXEL_OFFSETS.len()),
        }
    }
}

/// The [`OFFSETS`] of each pixel of a film, row by row from the bottom.
pub fn every_pixel(film: UVec2) -> impl Iterator<Item = Sample> {
    (0..film.y)
        .flat_map(move |y| (0..film.x).map(move |x| UVec2::new(x, y)))
        .flat_map(|pixel| PIXEL_OFFSETS.map(|offset| Sample { pixel, offset }))
}

/// A pinhole camera of the exam's own, so that a picture of shapes does not depend on the
/// submission's camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExamCamera {
    /// Where every ray starts.
    pub eye: Vec3,
    /// From the eye to the middle of the film.
    pub forward: Vec3,
    /// From the middle of the film to the middle of its right edge.
    pub right: Vec3,
    /// From the middle of the film to the middle of its upper edge.
    pub up: Vec3,
    /// The number of pixels, across and up.
    pub film: UVec2,
}

impl ExamCamera {
    /// The ray through a place on the film, with range `[0, ∞)`. The offset may leave `[0, 1)`.
    pub fn ray(&self, sample: Sample) -> Ray {
        let place = (sample.pixel.as_vec2() + sample.offset) / self.film.as_vec2() * 2.0 - 1.0;
        Ray::new(
            self.eye,
            self.forward + self.right * place.x + self.up * place.y,
        )
    }
}

/// The rays that a question asks about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rays {
    /// These rays.
    List(#[serde(with = "packed")] Vec<Ray>),
    /// The rays of a picture, through the five [`OFFSETS`] of each pixel.
    View(ExamCamera),
}

impl Rays {
    /// Every ray, in order.
    pub fn to_vec(&self) -> Vec<Ray> {
        match self {
            Rays::List(list) => list.clone(),
            Rays::View(view) => every_pixel(view.film)
                .map(|sample| view.ray(sample))
                .collect(),
        }
    }

    /// How many rays there are.
    pub fn count(&self) -> usize {
        match self {
            Rays::List(list) => list.len(),
            Rays::View(view) => Samples::EveryPixel.count(view.film),
        }
    }
}
