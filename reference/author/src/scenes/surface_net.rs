//! Extracts the surface where a function is zero, as a mesh.
//!
//! The method is Gibson's, "Constrained Elastic Surface Nets", 1998, without the relaxation: one
//! vertex in each cell that the surface passes through, and one quadrilateral around each grid edge
//! that the surface crosses.

use std::collections::HashMap;

use glam::{DVec3, IVec3, ivec3};

/// Vertices, and triangles whose corners are counter-clockwise when seen from outside.
pub(super) struct Net {
    pub(super) positions: Vec<DVec3>,
    pub(super) triangles: Vec<[usize; 3]>,
}

/// Extracts the surface of the solid where `solid` is negative, on a grid of `cells`³ cells that
/// covers the cube from −`half` to `half`. The solid must not touch the faces of the cube.
pub(super) fn extract_surface(solid: impl Fn(DVec3) -> f64, half: f64, cells: i32) -> Net {
    let position = |at: IVec3| (at.as_dvec3() / f64::from(cells) * 2.0 - 1.0) * half;
    let values: HashMap<IVec3, f64> = grid(cells + 1)
        .map(|at| (at, solid(position(at))))
        .collect();

    let mut net = Net {
        positions: Vec::new(),
        triangles: Vec::new(),
    };
    let mut corners: HashMap<IVec3, usize> = HashMap::new();
    for cell in grid(cells) {
        let cuts: Vec<DVec3> = EDGES
            .iter()
            .map(|&(from, to)| (cell + from, cell + to))
            .filter(|(from, to)| (values[from] < 0.0) != (values[to] < 0.0))
            .map(|(from, to)| {
                let along = values[&from] / (values[&from] - values[&to]);
                position(from).lerp(position(to), along)
            })
            .collect();
        if !cuts.is_empty() {
            corners.insert(cell, net.positions.len());
            net.positions
                .push(cuts.iter().sum::<DVec3>() / cuts.len() as f64);
        }
    }
    for from in grid(cells) {
        for (along, u, v) in [
            (IVec3::X, IVec3::Y, IVec3::Z),
            (IVec3::Y, IVec3::Z, IVec3::X),
            (IVec3::Z, IVec3::X, IVec3::Y),
        ] {
            let inside = [from, from + along].map(|at| values[&at] < 0.0);
            // The four cells around the edge, counter-clockwise as seen from its far end.
            let cells_around = [from - u - v, from - v, from, from - u];
            let [a, b, c, d] = match inside {
                [true, false] => cells_around.map(|cell| corners[&cell]),
                [false, true] => {
                    let [a, b, c, d] = cells_around.map(|cell| corners[&cell]);
                    [a, d, c, b]
                }
                [true, true] | [false, false] => continue,
            };
            net.quadrilateral([a, b, c, d]);
        }
    }
    net
}

impl Net {
    /// Adds two triangles that share the shorter diagonal of the quadrilateral.
    fn quadrilateral(&mut self, [a, b, c, d]: [usize; 4]) {
        let length = |from: usize, to: usize| self.positions[from].distance(self.positions[to]);
        let halves = if length(a, c) <= length(b, d) {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, b, d], [b, c, d]]
        };
        self.triangles.extend(halves);
    }
}

/// Returns all integer positions from 0 to `side` − 1 along each axis, in a fixed order.
fn grid(side: i32) -> impl Iterator<Item = IVec3> {
    let plane = move |z| (0..side).flat_map(move |y| (0..side).map(move |x| ivec3(x, y, z)));
    (0..side).flat_map(plane)
}

/// The twelve edges of a cell.
const EDGES: [(IVec3, IVec3); 12] = [
    (ivec3(0, 0, 0), ivec3(1, 0, 0)),
    (ivec3(0, 1, 0), ivec3(1, 1, 0)),
    (ivec3(0, 0, 1), ivec3(1, 0, 1)),
    (ivec3(0, 1, 1), ivec3(1, 1, 1)),
    (ivec3(0, 0, 0), ivec3(0, 1, 0)),
    (ivec3(1, 0, 0), ivec3(1, 1, 0)),
    (ivec3(0, 0, 1), ivec3(0, 1, 1)),
    (ivec3(1, 0, 1), ivec3(1, 1, 1)),
    (ivec3(0, 0, 0), ivec3(0, 0, 1)),
    (ivec3(1, 0, 0), ivec3(1, 0, 1)),
    (ivec3(0, 1, 0), ivec3(0, 1, 1)),
    (ivec3(1, 1, 0), ivec3(1, 1, 1)),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_gives_a_closed_outward_mesh_of_the_right_volume() {
        let net = extract_surface(|p| p.length() - 1.0, 1.25, 20);
        assert!(
            net.positions
                .iter()
                .all(|p| (p.length() - 1.0).abs() < 0.02)
        );
        // The divergence theorem gives the volume only if the mesh is closed and faces outward.
        let volume: f64 = net
            .triangles
            .iter()
            .map(|triangle| triangle.map(|corner| net.positions[corner]))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        let expected = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((volume / expected - 1.0).abs() < 0.02, "{volume}");
    }
}
