//! Meshes as they are handled between the file and the scene.

use glam::{Mat3, Vec2, Vec3};
use protocol::{Shape, Vertex};

use super::file::MeshEntry;
use crate::math::sin_cos;

/// Triangles that share their corners' positions, and so know their neighbours. Normals and
/// texture coordinates belong to a triangle's corner: at seams they differ.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub(super) positions: Vec<Vec3>,
    pub(super) faces: Vec<Face>,
}

/// One triangle of a [`Mesh`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Places in [`Mesh::positions`].
    pub(super) corners: [usize; 3],
    pub(super) uv: [Vec2; 3],
    /// `None` where the file gives none: then the face is flat.
    pub(super) normals: Option<[Vec3; 3]>,
}

impl Mesh {
    /// The shapes of the mesh, where the scene puts it. Triangles without area are left out: no
    /// ray meets one, and it has no normal.
    pub(super) fn shapes(&self, put: &MeshEntry, material: u32) -> Vec<Shape> {
        let turn = rotation(put.rotate);
        let place = |p: Vec3| turn * (p * put.scale) + put.translate;
        let positions: Vec<Vec3> = self.positions.iter().copied().map(place).collect();
        let shape = |face: &Face| {
            let corners = face.corners.map(|corner| positions[corner]);
            let flat = cross(corners).try_normalize()?;
            let normals = match face.normals {
                Some(normals) => normals.map(|normal| (turn * normal).normalize_or(flat)),
                None => [flat; 3],
            };
            let vertex = |i: usize| Vertex::new(corners[i], normals[i], face.uv[i]);
            Some(Shape::Triangle {
                vertices: [vertex(0), vertex(1), vertex(2)],
                material,
            })
        };
        self.faces.iter().filter_map(shape).collect()
    }

    /// The same mesh with a normal at each position, between those of the faces around it,
    /// weighted by area.
    pub(super) fn with_smooth_normals(mut self) -> Self {
        let mut normals = vec![Vec3::ZERO; self.positions.len()];
        for face in &self.faces {
            let weighted = cross(face.corners.map(|corner| self.positions[corner]));
            for corner in face.corners {
                normals[corner] += weighted;
            }
        }
        for face in &mut self.faces {
            let around = face.corners.map(|corner| normals[corner]);
            face.normals = Some(around.map(Vec3::normalize_or_zero));
        }
        self
    }
}

/// Along a triangle's normal, twice as long as it has area.
fn cross([p0, p1, p2]: [Vec3; 3]) -> Vec3 {
    (p1 - p0).cross(p2 - p0)
}

/// Turns about x, then y, then z, by angles in degrees.
fn rotation(degrees: Vec3) -> Mat3 {
    let [(sx, cx), (sy, cy), (sz, cz)] = degrees.to_array().map(|a| sin_cos(a.to_radians()));
    let x = Mat3::from_cols_array_2d(&[[1.0, 0.0, 0.0], [0.0, cx, sx], [0.0, -sx, cx]]);
    let y = Mat3::from_cols_array_2d(&[[cy, 0.0, -sy], [0.0, 1.0, 0.0], [sy, 0.0, cy]]);
    let z = Mat3::from_cols_array_2d(&[[cz, sz, 0.0], [-sz, cz, 0.0], [0.0, 0.0, 1.0]]);
    z * y * x
}

#[cfg(test)]
mod tests {
    use glam::vec3;

    use super::*;

    #[test]
    fn a_quarter_turn_about_each_axis_is_right_handed() {
        let turned = |degrees: Vec3, v: Vec3| rotation(degrees) * v;
        let quarter = 90.0;
        assert!(turned(Vec3::X * quarter, Vec3::Y).abs_diff_eq(Vec3::Z, 1e-6));
        assert!(turned(Vec3::Y * quarter, Vec3::Z).abs_diff_eq(Vec3::X, 1e-6));
        assert!(turned(Vec3::Z * quarter, Vec3::X).abs_diff_eq(Vec3::Y, 1e-6));
        // x first, then z.
        let both = turned(vec3(quarter, 0.0, quarter), Vec3::Z);
        assert!(both.abs_diff_eq(Vec3::X, 1e-6), "{both}");
    }
}
