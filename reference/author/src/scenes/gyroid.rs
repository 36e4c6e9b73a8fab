//! A ball carved out of a gyroid: one surface, full of holes, that no box fits well.

use std::f64::consts::TAU;

use glam::DVec3;
use libm::{cos, sin};

use super::obj::Obj;
use super::surface_net::extract_surface;

/// From one repetition of the gyroid to the next, in radii of the ball.
const PERIOD: f64 = 0.8;

/// How wide the rim is where both meet, in radii of the ball: sharp edges would become spikes.
const BLEND_WIDTH: f64 = 0.3;

const ABOUT: &str = "\
One side of Schoen's gyroid (NASA TN D-5541, 1970) within a ball of radius 1.
Coarse on purpose: made to be subdivided. Written by `cargo author scenes`.";

/// The mesh.
pub(super) fn obj() -> String {
    let net = extract_surface(solid, 1.05, 28);
    let mut obj = Obj::new(ABOUT);
    let positions: Vec<usize> = net
        .positions
        .iter()
        .map(|position| obj.position(position.to_array()))
        .collect();
    for triangle in net.triangles {
        obj.triangle(triangle.map(|corner| positions[corner]));
    }
    obj.finish()
}

/// Negative inside.
fn solid(p: DVec3) -> f64 {
    let DVec3 { x, y, z } = p * (TAU / PERIOD);
    let gyroid = sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
    // About a distance, as the ball's is: the gyroid's slope is about one and a half.
    let distance = gyroid / 1.5 * (PERIOD / TAU);
    smooth_max(distance, p.length() - 1.0)
}

/// The larger of two, rounded where they are less than [`RIM`] apart.
fn smooth_max(a: f64, b: f64) -> f64 {
    let overlap = (1.0 - (a - b).abs() / BLEND_WIDTH).max(0.0);
    a.max(b) + overlap * overlap * BLEND_WIDTH / 4.0
}
