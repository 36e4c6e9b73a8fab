//! A gyroid inside a ball: a surface with many holes, which bounding boxes fit badly.

use std::f64::consts::TAU;

use glam::DVec3;
use libm::{cos, sin};

use super::obj::Obj;
use super::surface_net::extract_surface;

/// The period of the gyroid, in radii of the ball.
const PERIOD: f64 = 0.8;

/// The width of the rounded edge between gyroid and ball, in radii of the ball. Sharp edges would
/// become spikes in the mesh.
const BLEND_WIDTH: f64 = 0.3;

const ABOUT: &str = "\
One side of Schoen's gyroid (NASA TN D-5541, 1970) within a ball of radius 1.
Coarse on purpose: made to be subdivided. Written by `cargo author scenes`.";

/// Returns the mesh as OBJ text.
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

/// Returns a value that is negative inside the solid and positive outside.
fn solid(p: DVec3) -> f64 {
    let DVec3 { x, y, z } = p * (TAU / PERIOD);
    let gyroid = sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
    // Scaled to be roughly a distance, like the value for the ball: the gyroid's gradient is about
    // 1.5.
    let distance = gyroid / 1.5 * (PERIOD / TAU);
    smooth_max(distance, p.length() - 1.0)
}

/// Returns the larger of two values, blended smoothly where they differ by less than
/// [`BLEND_WIDTH`].
fn smooth_max(a: f64, b: f64) -> f64 {
    let overlap = (1.0 - (a - b).abs() / BLEND_WIDTH).max(0.0);
    a.max(b) + overlap * overlap * BLEND_WIDTH / 4.0
}
