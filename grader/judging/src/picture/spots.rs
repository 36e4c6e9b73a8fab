//! The pixels that say most about what is wrong.

use std::cmp::Ordering;

use glam::UVec2;

use crate::judge::{Aspect, Blemish};

/// How many are picked.
const MOST: usize = 5;
/// No two of them are nearer than this part of the film: five neighbours say no more than one.
const APART: f32 = 1.0 / 9.0;

/// One bad pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// (0, 0) is at the bottom left.
    pub pixel: UVec2,
    /// Its worst position, as an element of the question.
    pub element: usize,
    /// What is wrong there.
    pub aspect: Aspect,
}

/// The worst pixels, the worst first: by the gravest aspect, then by how far off it is.
pub(super) fn worst(film: UVec2, per_pixel: usize, blemishes: &[Option<Blemish>]) -> Vec<Spot> {
    let spot = |(pixel, positions): (usize, &[Option<Blemish>])| {
        let found = positions.iter().enumerate();
        let found = found.filter_map(|(i, blemish)| Some((i, (*blemish)?)));
        let (position, blemish) = found.min_by(|(_, a), (_, b)| graver(a, b))?;
        let pixel = pixel as u32;
        let spot = Spot {
            pixel: UVec2::new(pixel % film.x, pixel / film.x),
            element: pixel as usize * per_pixel + position,
            aspect: blemish.aspect,
        };
        Some((spot, blemish))
    };
    let all: Vec<(Spot, Blemish)> = blemishes
        .chunks(per_pixel)
        .enumerate()
        .filter_map(spot)
        .collect();

    let apart = film.max_element() as f32 * APART;
    let mut picked: Vec<Spot> = Vec::new();
    while picked.len() < MOST {
        let far = all
            .iter()
            .map(|(spot, blemish)| (spot, blemish, away(&picked, spot)));
        let far = far.filter(|(_, _, away)| *away >= apart);
        // Where nothing else tells two apart, the farther from those that are picked.
        let next = far.min_by(|(_, a, near), (_, b, far)| graver(a, b).then(far.total_cmp(near)));
        match next {
            Some((spot, _, _)) => picked.push(*spot),
            None => break,
        }
    }
    picked
}

/// How far a pixel is from the nearest of these, in pixels.
fn away(picked: &[Spot], spot: &Spot) -> f32 {
    let place = spot.pixel.as_vec2();
    let distances = picked
        .iter()
        .map(|other| other.pixel.as_vec2().distance(place));
    distances.fold(f32::INFINITY, f32::min)
}

fn graver(a: &Blemish, b: &Blemish) -> Ordering {
    let aspect = a.aspect.cmp(&b.aspect);
    aspect.then_with(|| b.off.total_cmp(&a.off))
}
