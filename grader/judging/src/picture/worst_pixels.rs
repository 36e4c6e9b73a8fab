//! Picks the wrong pixels that are most useful for finding a mistake.

use std::cmp::Ordering;

use glam::UVec2;

use crate::judge::{Aspect, Mismatch};

/// Maximum number of pixels to pick.
const MAX_PIXELS: usize = 5;
/// Minimum distance between two picked pixels, relative to the film's larger side. Neighbours
/// rarely show different errors.
const MIN_SEPARATION: f32 = 1.0 / 9.0;

/// A wrong pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPixel {
    /// Coordinates of the pixel. (0, 0) is at the bottom left.
    pub pixel: UVec2,
    /// The pixel's worst position, as the index of an element in the question.
    pub element: usize,
    /// The kind of error at that position.
    pub aspect: Aspect,
}

/// Picks the worst pixels: first by the severity of the wrong aspect, then by the size of the
/// error.
pub(super) fn pick(
    film: UVec2,
    per_pixel: usize,
    mismatches: &[Option<Mismatch>],
) -> Vec<WorstPixel> {
    let candidate = |(pixel, positions): (usize, &[Option<Mismatch>])| {
        let found = positions.iter().enumerate();
        let found = found.filter_map(|(i, mismatch)| Some((i, (*mismatch)?)));
        let (position, mismatch) = found.min_by(|(_, a), (_, b)| by_severity(a, b))?;
        let pixel = pixel as u32;
        let candidate = WorstPixel {
            pixel: UVec2::new(pixel % film.x, pixel / film.x),
            element: pixel as usize * per_pixel + position,
            aspect: mismatch.aspect,
        };
        Some((candidate, mismatch))
    };
    let all: Vec<(WorstPixel, Mismatch)> = mismatches
        .chunks(per_pixel)
        .enumerate()
        .filter_map(candidate)
        .collect();

    let min_distance = film.max_element() as f32 * MIN_SEPARATION;
    let mut picked: Vec<WorstPixel> = Vec::new();
    while picked.len() < MAX_PIXELS {
        let far = all.iter().map(|(candidate, mismatch)| {
            (candidate, mismatch, distance_to_nearest(&picked, candidate))
        });
        let far = far.filter(|(_, _, distance)| *distance >= min_distance);
        // Among equally wrong pixels, pick the pixel farthest from all pixels that are already
        // picked.
        let next =
            far.min_by(|(_, a, near), (_, b, far)| by_severity(a, b).then(far.total_cmp(near)));
        match next {
            Some((candidate, _, _)) => picked.push(*candidate),
            None => break,
        }
    }
    picked
}

/// Returns the distance to the nearest of the picked pixels, in pixels.
fn distance_to_nearest(picked: &[WorstPixel], candidate: &WorstPixel) -> f32 {
    let position = candidate.pixel.as_vec2();
    let distances = picked
        .iter()
        .map(|other| other.pixel.as_vec2().distance(position));
    distances.fold(f32::INFINITY, f32::min)
}

fn by_severity(a: &Mismatch, b: &Mismatch) -> Ordering {
    let aspect = a.aspect.cmp(&b.aspect);
    aspect.then_with(|| b.deviation.total_cmp(&a.deviation))
}
