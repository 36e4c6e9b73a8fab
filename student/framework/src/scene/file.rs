//! The keys of a scene file. For any other key, the error lists the known ones.

use glam::Vec3;
use serde::Deserialize;

use super::camera::Camera;
use super::material::Material;
use super::number;
use super::ordered_map::OrderedMap;
use super::polygon::Polygon;

/// The contents of a scene file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    /// A description of the scene.
    #[serde(default)]
    pub(super) about: String,
    pub(super) camera: Camera,
    /// The radiance of the environment; default: black.
    #[serde(default, deserialize_with = "number::radiance")]
    pub(super) environment: Vec3,
    pub(super) materials: OrderedMap<Material>,
    pub(super) shapes: Vec<ShapeEntry>,
}

/// An entry of `shapes`. The kind of shape is a key (`{ "sphere": { ... } }`) and not the value of
/// a key `type`, because with such a key, the parser would not know the line of an error in the
/// entry.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum ShapeEntry {
    /// A sphere.
    Sphere {
        #[serde(deserialize_with = "number::triple")]
        center: Vec3,
        #[serde(deserialize_with = "number::positive")]
        radius: f32,
        material: String,
    },
    /// A flat, convex polygon.
    Polygon(Polygon),
    /// A mesh in a separate OBJ file.
    Mesh(MeshEntry),
}

impl ShapeEntry {
    /// Returns the name of the material.
    pub(super) fn material(&self) -> &str {
        match self {
            ShapeEntry::Sphere { material, .. } => material,
            ShapeEntry::Polygon(polygon) => &polygon.material,
            ShapeEntry::Mesh(mesh) => &mesh.material,
        }
    }
}

/// A mesh. It is scaled, rotated about the x-, y- and z-axes in this order, and then translated.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshEntry {
    /// The path of the OBJ file, relative to the folder of the scene file.
    pub(super) file: String,
    pub(super) material: String,
    /// The number of Loop subdivisions. Each splits every triangle into four. The subdivided mesh
    /// has smooth normals.
    #[serde(default)]
    pub(super) subdivide: u32,
    #[serde(default = "one", deserialize_with = "number::positive")]
    pub(super) scale: f32,
    /// The angles about the x-, y- and z-axes, in degrees.
    #[serde(default, deserialize_with = "number::triple")]
    pub(super) rotate: Vec3,
    #[serde(default, deserialize_with = "number::triple")]
    pub(super) translate: Vec3,
}

fn one() -> f32 {
    1.0
}
