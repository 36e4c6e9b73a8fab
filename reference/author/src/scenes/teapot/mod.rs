//! Martin Newell's teapot, from its Bézier patches.
//!
//! Newell, "The Utilization of Procedure Models in Digital Image Synthesis", University of Utah,
//! 1975. This is the published table with the bottom added and with Blinn's reduced height. The pot
//! is symmetric, so the table lists each patch once and its mirror images are derived.

mod table;

use glam::DVec3;

use self::table::{PATCHES, Patch, Symmetry};
use super::obj::Obj;

/// The number of squares along each side of a tessellated patch.
const SQUARES: usize = 8;

const ABOUT: &str = "\
The Utah teapot: Martin Newell's patches (1975), with normals and texture coordinates.
Written by `cargo author scenes`.";

/// Returns the mesh as OBJ text. The pot stands on y = 0, and its spout points toward +x.
pub(super) fn obj() -> String {
    let mut obj = Obj::new(ABOUT);
    for patch in PATCHES {
        for control in mirror_images(patch) {
            tessellate(&control, &mut obj);
        }
    }
    obj.finish()
}

/// The sixteen control points of a Bézier patch, row by row.
type ControlPoints = [[DVec3; 4]; 4];

/// Returns a patch and its mirror images. Mirroring turns a patch inside out, so the rows of a
/// mirrored patch are reversed.
fn mirror_images(patch: &Patch) -> Vec<ControlPoints> {
    let control = patch.control_points();
    let image = |scale: DVec3, is_reversed: bool| {
        control.map(|mut row| {
            if is_reversed {
                row.reverse();
            }
            row.map(|point| point * scale)
        })
    };
    let mut images = vec![control, image(DVec3::new(1.0, -1.0, 1.0), true)];
    match patch.symmetry {
        Symmetry::LeftAndRight => {}
        Symmetry::AllAround => {
            images.push(image(DVec3::new(-1.0, 1.0, 1.0), true));
            images.push(image(DVec3::new(-1.0, -1.0, 1.0), false));
        }
    }
    images
}

fn tessellate(control: &ControlPoints, obj: &mut Obj) {
    let along = |i: usize| i as f64 / SQUARES as f64;
    let mut corner = |i: usize, j: usize| {
        let (u, v) = (along(i), along(j));
        let (position, normal) = (y_up(point_at(control, u, v)), y_up(normal(control, u, v)));
        (obj.position(position), obj.uv([u, v]), obj.normal(normal))
    };
    let corners: Vec<Vec<_>> = (0..=SQUARES)
        .map(|j| (0..=SQUARES).map(|i| corner(i, j)).collect())
        .collect();
    for (j, i) in (0..SQUARES).flat_map(|j| (0..SQUARES).map(move |i| (j, i))) {
        let (a, b) = (corners[j][i], corners[j][i + 1]);
        let (d, c) = (corners[j + 1][i], corners[j + 1][i + 1]);
        obj.full_triangle([a, b, c]);
        obj.full_triangle([a, c, d]);
    }
}

/// Converts from Newell's coordinates, where z is up, to ours, where y is up.
fn y_up(v: DVec3) -> [f64; 3] {
    [v.x, v.z, -v.y]
}

/// Returns the point of the patch at u along the rows and v across them.
fn point_at(control: &ControlPoints, u: f64, v: f64) -> DVec3 {
    let rows = control.map(|row| weighted_sum(row, bernstein(u)));
    weighted_sum(rows, bernstein(v))
}

/// Returns the outward normal. Where a side of the patch degenerates to a point, returns the normal
/// next to that point.
fn normal(control: &ControlPoints, u: f64, v: f64) -> DVec3 {
    let normal_at = |u: f64, v: f64| {
        let along = weighted_sum(
            control.map(|row| weighted_sum(row, bernstein_derivatives(u))),
            bernstein(v),
        );
        let across = weighted_sum(
            control.map(|row| weighted_sum(row, bernstein(u))),
            bernstein_derivatives(v),
        );
        along.cross(across)
    };
    let inside = |t: f64| t.clamp(1e-4, 1.0 - 1e-4);
    let normal = normal_at(u, v);
    if normal.length() > 1e-9 {
        normal.normalize()
    } else {
        normal_at(inside(u), inside(v)).normalize()
    }
}

fn weighted_sum(points: [DVec3; 4], weights: [f64; 4]) -> DVec3 {
    points
        .iter()
        .zip(weights)
        .map(|(point, weight)| *point * weight)
        .sum()
}

/// Evaluates the cubic Bernstein polynomials.
fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// Evaluates the derivatives of the cubic Bernstein polynomials.
fn bernstein_derivatives(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [
        -3.0 * s * s,
        3.0 * s * s - 6.0 * s * t,
        6.0 * s * t - 3.0 * t * t,
        3.0 * t * t,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bodys_normals_point_away_from_its_axis() {
        // The second patch is the upper body, which has no overhang.
        for control in mirror_images(&PATCHES[1]) {
            let (middle, normal) = (point_at(&control, 0.5, 0.5), normal(&control, 0.5, 0.5));
            let outward = DVec3::new(middle.x, middle.y, 0.0);
            assert!(normal.dot(outward) > 0.5, "{normal} at {middle}");
        }
    }

    #[test]
    fn has_32_patches_and_the_published_height() {
        let controls: Vec<ControlPoints> = PATCHES.iter().flat_map(mirror_images).collect();
        assert_eq!(controls.len(), 32);
        let heights = controls.iter().flatten().flatten().map(|point| point.z);
        let (low, high) = heights.fold((9.0, 0.0), |(low, high), z| {
            (f64::min(low, z), f64::max(high, z))
        });
        assert_eq!((low, high), (0.0, 3.15));
    }
}
