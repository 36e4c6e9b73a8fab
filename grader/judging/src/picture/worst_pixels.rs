//! The pixels that say most about what is wrong.

use std::cmp::Ordering;

use glam::UVec2;

use crate::judge::{Aspect, Mismatch};

/// How many are picked.
const MAX_PIXELS: usize = 5;
/// No two of them are nearer than this part of the film: five neighbours say no more than one.
const MIN_SEPARATION: f32 = 1.0 / 9.0;

/// One bad pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPixel {
    /// (0, 0) is at the bottom left.
    pub pixel: UVec2,
    /// Its worst position, as an element of the question.
    pub element: usize,
    /// What is wrong there.
    pub aspect: Aspect,
}

/// The worst pixels, the worst first: by the gravest aspect, then by how far off it is.
pub(super) fn pick(
    film: UVec2,
    per_pixel: usize,
    blemishes: &[Option<Mismatch>],
) -> Vec<WorstPixel> {
    let spot = |(pixel, positions): (usize, &[Option<Mismatch>])| {
        let found = positions.iter().enumerate();
        let found = found.filter_map(|(i, blemish)| Some((i, (*blemish)?)));
        let (position, blemish) = found.min_by(|(_, a), (_, b)| by_severity(a, b))?;
        let pixel = pixel as u32;
        let spot = WorstPixel {
            pixel: UVec2::new(pixel % film.x, pixel / film.x),
            element: pixel as usize * per_pixel + position,
            aspect: blemish.aspect,
        };
        Some((spot, blemish))
    };
    let all: Vec<(WorstPixel, Mismatch)> = blemishes
        .chunks(per_pixel)
        .enumerate()
        .filter_map(spot)
        .collect();

    let apart = film.max_element() as f32 * MIN_SEPARATION;
    let mut picked: Vec<WorstPixel> = Vec::new();
    while picked.len() < MAX_PIXELS {
        let far = all
            .iter()
            .map(|(spot, blemish)| (spot, blemish, distance_to_nearest(&picked, spot)));
        let far = far.filter(|(_, _, away)| *away >= apart);
        // Where nothing else tells two apart, the farther from those that are picked.
        let next =
            far.min_by(|(_, a, near), (_, b, far)| by_severity(a, b).then(far.total_cmp(near)));
        match next {
            Some((spot, _, _)) => picked.push(*spot),
            None => break,
        }
    }
    picked
}

/// How far a pixel is from the nearest of these, in pixels.
fn distance_to_nearest(picked: &[WorstPixel], spot: &WorstPixel) -> f32 {
    let place = spot.pixel.as_vec2();
    let distances = picked
        .iter()
        .map(|other| other.pixel.as_vec2().distance(place));
    distances.fold(f32::INFINITY, f32::min)
}

fn by_severity(a: &Mismatch, b: &Mismatch) -> Ordering {
    let aspect = a.aspect.cmp(&b.aspect);
    aspect.then_with(|| b.deviation.total_cmp(&a.deviation))
}
