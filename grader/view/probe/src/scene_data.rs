//! A scene as it is sent to a probe, which cannot read files.

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
    /// For each shape, the index of its shape.
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
    /// The tree that the submission's `Bvh::build` builds.
    Build,
    /// A tree of the exam.
    Prebuilt(Tree),
    /// No tree: all primitives are tested.
    List,
}

/// A shape that can be sent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneMaterial(#[serde(with = "MaterialDef")] pub Material);

/// The variants of [`Material`], for `serde`: a scene file has other checks and another form.
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
    /// Returns the data of a scene whose tree is to be built.
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
            camera: self.aim.camera(),
            environment: self.environment,
            materials: self.materials.into_iter().map(|shape| shape.0).collect(),
            shapes: self.shapes,
            shape_materials: self.shape_materials,
            max_leaf_size: self.max_leaf_size as usize,
        }
    }
}

/// A camera and its position, and the settings of paths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// The parameters of the submission's camera.
    pub pinhole: PinholeCamera,
    /// The position of the camera in world space.
    pub position: Vec3,
    /// The camera's axes in world space, as columns.
    pub axes: Mat3,
    /// The maximum number of times that a path is scattered.
    pub bounces: u32,
    /// The seed of all random numbers.
    pub seed: u64,
}

impl Aim {
    /// Returns the camera of a scene.
    pub fn camera(&self) -> Camera {
        Camera {
            pinhole: self.pinhole,
            placement: Placement {
                position: self.position,
                axes: self.axes,
            },
            fixed_aspect: true,
        }
    }
}
