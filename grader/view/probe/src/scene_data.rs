//! A scene as sent to a probe, which cannot read files.

use framework::scene::{Camera, Material, Placement, Scene};
use glam::{Mat3, Vec3};
use protocol::{PinholeCamera, Shape, Tree};
use serde::{Deserialize, Serialize};

/// A scene without its camera.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SceneData {
    /// The radiance of the environment.
    pub environment: Vec3,
    /// The materials.
    pub materials: Vec<SceneMaterial>,
    /// All shapes, numbered like those of a [`Scene`].
    pub shapes: Vec<Shape>,
    /// For each shape, the index of its material.
    pub shape_materials: Vec<u32>,
    /// The maximum number of primitives in a leaf.
    pub max_leaf_size: u32,
    /// The tree to traverse.
    pub tree: TreeSource,
    /// The first camera.
    pub aim: Aim,
    /// Whether the rays and tests are recorded.
    pub is_recorded: bool,
}

/// The tree to traverse.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum TreeSource {
    /// The tree built by the submission's `Bvh::build`.
    Build,
    /// A tree from the exam.
    Prebuilt(Tree),
    /// No tree: all primitives are tested.
    List,
}

/// A material that can be sent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneMaterial(#[serde(with = "MaterialDef")] pub Material);

/// The variants of [`Material`], for `serde`. Scene files use a different form and different
/// checks.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Material")]
enum MaterialDef {
    Lambertian { albedo: Vec3 },
    Checker { a: Vec3, b: Vec3, scale: f32 },
    Mirror { reflectance: Vec3 },
    Glass { ior: f32 },
    Emitter { radiance: Vec3 },
}

impl SceneData {
    /// Returns the data of a scene whose tree should be built.
    pub fn new(scene: &Scene, aim: Aim) -> Self {
        SceneData {
            environment: scene.environment,
            materials: scene.materials.iter().copied().map(SceneMaterial).collect(),
            shapes: scene.shapes.clone(),
            shape_materials: scene.shape_materials.clone(),
            max_leaf_size: u32::try_from(scene.max_leaf_size).unwrap_or(u32::MAX),
            tree: TreeSource::Build,
            aim,
            is_recorded: false,
        }
    }

    /// Converts the data to a scene.
    pub(crate) fn into_scene(self) -> Scene {
        Scene {
            about: String::new(),
            camera: self.aim.camera,
            environment: self.environment,
            materials: self
                .materials
                .into_iter()
                .map(|material| material.0)
                .collect(),
            shapes: self.shapes,
            shape_materials: self.shape_materials,
            max_leaf_size: self.max_leaf_size as usize,
        }
    }
}

/// A camera and the settings of paths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// The camera and its position.
    #[serde(with = "CameraDef")]
    pub camera: Camera,
    /// The settings.
    pub settings: PathSettings,
}

/// The settings of paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PathSettings {
    /// The maximum number of times a path is scattered.
    pub bounces: u32,
    /// The seed of all random numbers.
    pub seed: u64,
}

/// The fields of [`Camera`], for `serde`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Camera")]
struct CameraDef {
    pinhole: PinholeCamera,
    #[serde(with = "PlacementDef")]
    placement: Placement,
    fixed_aspect: bool,
}

/// The fields of [`Placement`], for `serde`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Placement")]
struct PlacementDef {
    position: Vec3,
    axes: Mat3,
}
