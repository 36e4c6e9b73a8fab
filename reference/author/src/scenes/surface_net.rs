//! A mesh around the solid where a function is negative.
//!
//! Gibson, "Constrained Elastic Surface Nets", 1998, without the relaxation: a corner in each
//! cell that the surface passes through, a quadrilateral around each grid edge that it cuts.

use std::collections::HashMap;

use glam::{DVec3, IVec3, ivec3};

/// Corners, and triangles that turn counter-clockwise seen from outside.
pub(super) struct Net {
    pub(super) positions: Vec<DVec3>,
    pub(super) triangles: Vec<[usize; 3]>,
}

/// The surface of `solid` inside the cube from −`half` to `half`, on `cells`³ cells. The solid must
/// not reach the cube's faces.
pub(super) fn extract_surface(solid: impl Fn(DVec3) -> f64, half: f64, cells: i32) -> Net {
    let place = |at: IVec3| (at.as_dvec3() / f64::from(cells) * 2.0 - 1.0) * half;
    let values: HashMap<IVec3, f64> = grid(cells + 1).map(|at| (at, solid(place(at)))).collect();

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
                place(from).lerp(place(to), along)
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
            // The four cells around the edge, counter-clockwise seen from its far end.
            let around = [from - u - v, from - v, from, from - u];
            let [a, b, c, d] = match inside {
                [true, false] => around.map(|cell| corners[&cell]),
                [false, true] => {
                    let [a, b, c, d] = around.map(|cell| corners[&cell]);
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
    /// Two triangles, along the shorter diagonal.
    fn quadrilateral(&mut self, [a, b, c, d]: [usize; 4]) {
        let length = |from: usize, to: usize| self.positions[from].distance(self.positions[to]);
        let halves = match length(a, c) <= length(b, d) {
            true => [[a, b, c], [a, c, d]],
            false => [[a, b, d], [b, c, d]],
        };
        self.triangles.extend(halves);
    }
}

/// All places from 0 to `side` − 1 along each axis, in a fixed order.
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
        // By the divergence theorem, which counts on every face being there and facing outward.
        let volume: f64 = net
            .triangles
            .iter()
            .map(|triangle| triangle.map(|corner| net.positions[corner]))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        let truth = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((volume / truth - 1.0).abs() < 0.02, "{volume}");
    }
}
