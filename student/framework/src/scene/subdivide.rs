//! Subdivides meshes by Loop's scheme, which refines a mesh and makes it smooth.
//!
//! See Charles Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987, with Warren's vertex
//! weights and the boundary rules of Hoppe et al., "Piecewise Smooth Surface Reconstruction",
//! SIGGRAPH 1994. With subdivision, a scene can have a hundred thousand triangles although its
//! files contain only a few thousand.

use std::collections::HashMap;

use glam::Vec3;

use super::mesh::{Face, Mesh};

/// Splits each triangle of a mesh into four and smooths the positions. Texture coordinates are
/// interpolated linearly, and normals are dropped.
pub(super) fn subdivide(mesh: &Mesh) -> Mesh {
    let edges = Edges::of(mesh);
    let mut positions = moved_positions(mesh, &edges);
    positions.extend(edges.list.iter().map(|edge| edge.middle(mesh)));

    let first_middle = mesh.positions.len();
    let split = |face: &Face| {
        let [a, b, c] = face.corners;
        let [ua, ub, uc] = face.uv;
        let middle = |from, to| first_middle + edges.indices[&edge_key(from, to)];
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        let (uab, ubc, uca) = (ua.midpoint(ub), ub.midpoint(uc), uc.midpoint(ua));
        let face = |corners, uv| Face {
            corners,
            uv,
            normals: None,
        };
        [
            face([a, ab, ca], [ua, uab, uca]),
            face([ab, b, bc], [uab, ub, ubc]),
            face([ca, bc, c], [uca, ubc, uc]),
            face([ab, bc, ca], [uab, ubc, uca]),
        ]
    };
    let faces = mesh.faces.iter().flat_map(split).collect();
    Mesh { positions, faces }
}

/// An edge and the corners opposite it: one corner for each face that has the edge.
struct Edge {
    ends: (usize, usize),
    across: Vec<usize>,
}

impl Edge {
    /// Returns whether the edge is smooth, which means that it has exactly two faces. With one face
    /// it is a boundary, and with three or more it is a crease.
    fn is_smooth(&self) -> bool {
        self.across.len() == 2
    }

    fn middle(&self, mesh: &Mesh) -> Vec3 {
        let at = |corner: usize| mesh.positions[corner];
        let ends = at(self.ends.0) + at(self.ends.1);
        match *self.across {
            [left, right] => 0.375 * ends + 0.125 * (at(left) + at(right)),
            _ => 0.5 * ends,
        }
    }
}

/// All edges of a mesh, in the order of their first use by a face.
struct Edges {
    list: Vec<Edge>,
    indices: HashMap<(usize, usize), usize>,
}

impl Edges {
    fn of(mesh: &Mesh) -> Self {
        let mut edges = Edges {
            list: Vec::new(),
            indices: HashMap::new(),
        };
        for face in &mesh.faces {
            let [a, b, c] = face.corners;
            for (from, to, across) in [(a, b, c), (b, c, a), (c, a, b)] {
                let next = edges.list.len();
                let index = *edges.indices.entry(edge_key(from, to)).or_insert(next);
                if index == next {
                    edges.list.push(Edge {
                        ends: edge_key(from, to),
                        across: Vec::with_capacity(2),
                    });
                }
                edges.list[index].across.push(across);
            }
        }
        edges
    }
}

/// Returns the key of an edge, which is the same in both directions.
fn edge_key(from: usize, to: usize) -> (usize, usize) {
    (from.min(to), from.max(to))
}

/// Returns the new positions of the mesh's vertices.
fn moved_positions(mesh: &Mesh, edges: &Edges) -> Vec<Vec3> {
    #[derive(Clone, Copy, Default)]
    struct Ring {
        sum: Vec3,
        count: u32,
    }
    let mut all = vec![Ring::default(); mesh.positions.len()];
    let mut creases = vec![Ring::default(); mesh.positions.len()];
    for edge in &edges.list {
        for (corner, other) in [edge.ends, (edge.ends.1, edge.ends.0)] {
            let join = |rings: &mut [Ring]| {
                rings[corner].sum += mesh.positions[other];
                rings[corner].count += 1;
            };
            join(&mut all);
            if !edge.is_smooth() {
                join(&mut creases);
            }
        }
    }
    let rings = all.iter().zip(&creases);
    let move_one = |(&position, (ring, crease)): (&Vec3, (&Ring, &Ring))| match crease.count {
        0 if ring.count > 0 => {
            let n = ring.count as f32;
            let weight = if ring.count == 3 { 0.1875 } else { 0.375 / n };
            (1.0 - n * weight) * position + weight * ring.sum
        }
        2 => 0.75 * position + 0.125 * crease.sum,
        // Two kinds of positions do not move: a corner, where one crease ends or several join, and
        // a position that no face uses.
        _ => position,
    };
    mesh.positions.iter().zip(rings).map(move_one).collect()
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, vec3};

    use super::*;

    fn mesh(positions: &[Vec3], corners: &[[usize; 3]]) -> Mesh {
        let face = |&corners: &[usize; 3]| Face {
            corners,
            uv: [Vec2::ZERO, Vec2::X, Vec2::Y],
            normals: None,
        };
        Mesh {
            positions: positions.to_vec(),
            faces: corners.iter().map(face).collect(),
        }
    }

    #[test]
    fn a_tetrahedron_stays_closed_and_grows_fourfold() {
        let corners = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
        let positions = [
            Vec3::ONE,
            vec3(1., -1., -1.),
            vec3(-1., 1., -1.),
            vec3(-1., -1., 1.),
        ];
        let fine = subdivide(&subdivide(&mesh(&positions, &corners)));
        assert_eq!(fine.faces.len(), 4 * 4 * 4);
        let edges = Edges::of(&fine);
        assert!(edges.list.iter().all(Edge::is_smooth));
        // Euler's formula for a surface like a sphere: corners − edges + faces = 2.
        assert_eq!(
            fine.positions.len() + fine.faces.len(),
            edges.list.len() + 2
        );
        // The mesh is symmetric about the origin before and after.
        let sum: Vec3 = fine.positions.iter().sum();
        assert!(sum.length() < 1e-4, "{sum}");
    }

    #[test]
    fn the_middle_of_an_inner_edge_depends_on_both_opposite_corners() {
        let positions = [
            Vec3::ZERO,
            vec3(8., 0., 0.),
            vec3(0., 8., 0.),
            vec3(8., 8., 8.),
        ];
        let fine = subdivide(&mesh(&positions, &[[0, 1, 2], [1, 3, 2]]));
        // 3/8 of each end of the shared edge, plus 1/8 of each corner opposite the edge.
        let middle = vec3(3. + 1., 3. + 1., 1.);
        assert!(fine.positions.contains(&middle), "{:?}", fine.positions);
        // On the boundary: half of each end.
        assert!(fine.positions.contains(&vec3(4., 0., 0.)));
    }
}
