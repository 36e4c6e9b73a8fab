//! The keys of a scene file. A key that is not here is an error that lists those that are.

use glam::Vec3;
use serde::Deserialize;

use super::camera::Camera;
use super::material::Material;
use super::number;
use super::ordered_map::OrderedMap;
use super::polygon::Polygon;

/// A whole scene file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    /// What the scene shows.
    #[serde(default)]
    pub(super) about: String,
    pub(super) camera: Camera,
    /// The radiance from all around; without it, none.
    #[serde(default, deserialize_with = "number::radiance")]
    pub(super) environment: Vec3,
    pub(super) materials: OrderedMap<Material>,
    pub(super) shapes: Vec<ShapeEntry>,
}

/// An entry of `shapes`. Kinds are keys (`{ "sphere": { ... } }`), not values of a key `type`:
/// so the parser still knows the line when it meets a mistake inside.
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
    /// A flat, convex outline.
    Polygon(Polygon),
    /// A mesh in an OBJ file of its own.
    Mesh(MeshEntry),
}

/// A mesh: scaled, then turned about x, then y, then z, then moved.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshEntry {
    /// An OBJ file beside the scene's.
    pub(super) file: String,
    pub(super) material: String,
    /// How often to subdivide after Loop; every time makes four triangles of one, and the
    /// normals smooth.
    #[serde(default)]
    pub(super) subdivide: u32,
    #[serde(default = "one", deserialize_with = "number::positive")]
    pub(super) scale: f32,
    /// Angles about the x, y and z axes, in degrees.
    #[serde(default, deserialize_with = "number::triple")]
    pub(super) rotate: Vec3,
    #[serde(default, deserialize_with = "number::triple")]
    pub(super) translate: Vec3,
}

fn one() -> f32 {
    1.0
}
