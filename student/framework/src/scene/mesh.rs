//! Meshes, as an intermediate form between the OBJ file and the shapes of a scene.

use glam::{Mat3, Vec2, Vec3};
use protocol::Vertex;

use super::value::MAX_COORDINATE;
use crate::math::sin_cos;

/// An indexed triangle mesh. Triangles share positions, which subdivision uses to find neighbours.
/// Normals and texture coordinates are stored per corner of a triangle, because they differ at
/// seams.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub(super) positions: Vec<Vec3>,
    pub(super) faces: Vec<Face>,
}

/// One triangle of a [`Mesh`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Indices into [`Mesh::positions`].
    pub(super) corners: [usize; 3],
    pub(super) uv: [Vec2; 3],
    /// The normals at the corners. `None` if the file has no normals; the triangle is then flat.
    pub(super) normals: Option<[Vec3; 3]>,
}

/// The position of a mesh in the scene. It is scaled, rotated about the x-, y- and z-axes in this
/// order, and then translated.
pub(super) struct Transform {
    pub(super) scale: f32,
    /// The angles about the x-, y- and z-axes, in degrees.
    pub(super) rotate: Vec3,
    pub(super) translate: Vec3,
}

impl Mesh {
    /// Returns the mesh's transformed triangles. Triangles without area are left out, because they
    /// have no normal and no ray can hit them.
    pub(super) fn triangles(&self, to: &Transform) -> Result<Vec<[Vertex; 3]>, String> {
        let rotation = rotation(to.rotate);
        let transform = |p: Vec3| rotation * (p * to.scale) + to.translate;
        let positions: Vec<Vec3> = self.positions.iter().copied().map(transform).collect();
        let is_in_range = |p: &Vec3| p.abs().max_element() <= MAX_COORDINATE;
        if !positions.iter().all(is_in_range) {
            let message = "the mesh has a coordinate beyond 1e9 after `scale`, `rotate` and \
                           `translate`: use smaller numbers";
            return Err(message.to_owned());
        }
        let vertices = |face: &Face| {
            let corners = face.corners.map(|corner| positions[corner]);
            let flat = cross(corners).try_normalize()?;
            let normals = match face.normals {
                Some(normals) => normals.map(|normal| (rotation * normal).normalize_or(flat)),
                None => [flat; 3],
            };
            let vertex = |i: usize| Vertex::new(corners[i], normals[i], face.uv[i]);
            Some([vertex(0), vertex(1), vertex(2)])
        };
        let triangles: Vec<[Vertex; 3]> = self.faces.iter().filter_map(vertices).collect();
        if triangles.is_empty() {
            let message = "no triangle of the mesh has an area, so no ray can hit it: use another \
                           mesh or `scale`";
            return Err(message.to_owned());
        }
        Ok(triangles)
    }

    /// Returns the same mesh with a normal at each position: the mean of the normals of the faces
    /// around it, weighted by area.
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

/// Returns the vector along a triangle's normal that is as long as twice the triangle's area.
fn cross([p0, p1, p2]: [Vec3; 3]) -> Vec3 {
    (p1 - p0).cross(p2 - p0)
}

/// Returns the rotation about the x-, y- and z-axes, in this order, by angles in degrees.
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
        let rotate = |degrees: Vec3, v: Vec3| rotation(degrees) * v;
        let quarter = 90.0;
        assert!(rotate(Vec3::X * quarter, Vec3::Y).abs_diff_eq(Vec3::Z, 1e-6));
        assert!(rotate(Vec3::Y * quarter, Vec3::Z).abs_diff_eq(Vec3::X, 1e-6));
        assert!(rotate(Vec3::Z * quarter, Vec3::X).abs_diff_eq(Vec3::Y, 1e-6));
        // About x first, then about z.
        let both = rotate(vec3(quarter, 0.0, quarter), Vec3::Z);
        assert!(both.abs_diff_eq(Vec3::X, 1e-6), "{both}");
    }
}
