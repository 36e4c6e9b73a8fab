//! Picks random boxes.

use glam::DVec3;

use super::aspects::{FOIL, THIN, THREAD};
use crate::domains::fields;
use crate::oracle::bbox::Bounds;
use crate::seed::Rng;

/// Picks a random box of this size. Up to two sides may be thin, and one may be flat.
pub(super) fn drawn_box(rng: &mut Rng, size: usize) -> Bounds {
    let size = fields::size(rng, size);
    let is_cube = rng.index(6) == 0;
    let least = if rng.coin() { 0.3 } else { 0.8 };
    let mut half = size * rng.vector(least, 1.0);
    let (axis, other) = (rng.index(3), rng.integer(1, 2) as usize);
    half[(axis + other) % 3] = size;
    let mut is_foil = false;
    match rng.index(8) {
        _ if is_cube => half = DVec3::splat(size),
        0 | 1 => half[axis] = 0.0,
        2 | 3 => half[axis] *= thin(rng),
        4 => {
            half[axis] = size * rng.log_uniform(8e-5, 0.95 * FOIL);
            is_foil = true;
        }
        _ => {}
    }
    if half[axis] < THIN * size && !is_foil && rng.index(3) == 0 {
        half[(axis + 3 - other) % 3] = size * thin(rng);
    }
    // Farther away, coordinates don't have enough digits to represent a box as thin as foil.
    let mut center = if is_foil {
        rng.point(0.9 * size)
    } else {
        fields::place(rng, size)
    };
    match rng.index(10) {
        0 => center = half * DVec3::from_array([rng.sign(), rng.sign(), rng.sign()]),
        1 => center[axis] = half[axis] * rng.sign(),
        2..=5 => [center, half] = exact(size, [center, half]),
        6 => {
            half[axis] = half[(axis + 1) % 3];
            [center, half] = exact(size, [center, half]);
        }
        _ if is_cube => [center, half] = exact(size, [center, half]),
        _ => {}
    }
    let mut bounds = Bounds::new((center - half).as_vec3(), (center + half).as_vec3());
    if half[axis] == 0.0 {
        bounds.max[axis] = bounds.min[axis];
    }
    bounds
}

/// Picks a random length for a short side, as a fraction of the box's size.
fn thin(rng: &mut Rng) -> f64 {
    match rng.index(3) {
        0 => rng.uniform(0.005, THIN),
        _ => rng.log_uniform(2e-4, THREAD),
    }
}

/// Returns a centre and half sides close to the given ones, such that the corners and the centre
/// are exact in single precision. Half sides that are too short for that are returned unchanged.
fn exact(size: f64, [center, half]: [DVec3; 2]) -> [DVec3; 2] {
    let step = size.log2().floor().exp2() / 256.0;
    let is_long = half.cmpge(DVec3::splat(step));
    let shorter = (half / step).floor() * step;
    [
        (center / step).trunc() * step,
        DVec3::select(is_long, shorter, half),
    ]
}

/// Returns a box that is shorter along an axis but has exactly the same centre in single precision.
pub(super) fn shorter(bounds: &Bounds, axis: usize) -> Bounds {
    /// The number of side lengths to try.
    const ATTEMPTS: usize = 256;
    let twice = bounds.min + bounds.max;
    let (mut min, mut max) = (bounds.min.as_vec3(), bounds.max.as_vec3());
    if min[axis] == max[axis] {
        return *bounds;
    }
    let shorter = 0.125 * (bounds.max - bounds.min)[axis];
    let mut low = (bounds.min[axis] + shorter) as f32;
    let mut high = || {
        low = low.next_up();
        (low, twice[axis] - f64::from(low))
    };
    let sides = (0..ATTEMPTS).map(|_| high());
    let sides: Vec<(f32, f64)> = sides.collect();
    let is_exact = |(_, high): &&(f32, f64)| f64::from(*high as f32) == *high;
    let (low, high) = *sides.iter().find(is_exact).unwrap_or(&sides[0]);
    (min[axis], max[axis]) = (low, high as f32);
    Bounds::new(min, max)
}
