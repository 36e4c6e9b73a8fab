//! Meshes, as an intermediate form between the OBJ file and the shapes of a scene.

use glam::{Mat3, Vec2, Vec3};
use protocol::Vertex;

use super::value::MAX_COORDINATE;
use crate::math::sin_cos;

/// A triangle of a mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) corners: [Vec3; 3],
    pub(super) uv: [Vec2; 3],
    /// The normals at the corners, or `None` if the file contains no normals. Without normals, the
    /// triangle is flat.
    pub(super) normals: Option<[Vec3; 3]>,
}

/// The position of a mesh in the scene. The mesh is scaled, then rotated about the x-axis, the
/// y-axis and the z-axis, and finally translated.
pub(super) struct Transform {
    pub(super) scale: f32,
    /// The angles of rotation about the x-, y- and z-axes, in degrees.
    pub(super) rotate: Vec3,
    pub(super) translate: Vec3,
}

impl Transform {
    /// Returns the transformed triangles of a mesh. Triangles without area are left out, because
    /// they have no normal and no ray can hit them.
    pub(super) fn apply(&self, mesh: &[Face]) -> Result<Vec<[Vertex; 3]>, String> {
        let rotation = rotation(self.rotate);
        let transform = |p: Vec3| rotation * (p * self.scale) + self.translate;
        let mut triangles = Vec::new();
        for face in mesh {
            let corners = face.corners.map(transform);
            if corners
                .iter()
                .any(|p| p.abs().max_element() > MAX_COORDINATE)
            {
                let message = "the mesh has a coordinate beyond 1e9 after `scale`, `rotate` and \
                               `translate`: use smaller numbers";
                return Err(message.to_owned());
            }
            let [p0, p1, p2] = corners;
            let Some(flat) = (p1 - p0).cross(p2 - p0).try_normalize() else {
                continue;
            };
            let normals = match face.normals {
                Some(normals) => normals.map(|normal| (rotation * normal).normalize_or(flat)),
                None => [flat; 3],
            };
            triangles.push([0, 1, 2].map(|i| Vertex::new(corners[i], normals[i], face.uv[i])));
        }
        if triangles.is_empty() {
            let message = "every triangle of the mesh has zero area, so no ray can hit it: use \
                           a different mesh or a different `scale`";
            return Err(message.to_owned());
        }
        Ok(triangles)
    }
}

/// Returns the rotation by these angles, in degrees, first about the x-axis, then about the y-axis
/// and then about the z-axis.
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
