//! A scene as sent to a probe, which cannot read files.

use std::borrow::Cow;

use framework::scene::{Camera, Environment, Material, Placement, Scene};
use glam::{Mat3, Vec3};
use protocol::{Panic, PinholeCamera, Shape, Tree};
use serde::{Deserialize, Serialize};

use crate::messages::SubmissionPart;

/// A scene and the first camera to view it with.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SceneData {
    /// The light of the environment.
    #[serde(with = "environment")]
    pub environment: Environment,
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

/// Returns the shapes that are drawn: those whose `hit` isn't among the missing parts.
pub fn written_shapes<'a>(
    shapes: &'a [Shape],
    missing: &[(SubmissionPart, Panic)],
) -> Cow<'a, [Shape]> {
    let has = |part| missing.iter().all(|(known, _)| *known != part);
    let (has_triangles, has_spheres) = (has(SubmissionPart::Triangle), has(SubmissionPart::Sphere));
    if has_triangles && has_spheres {
        return Cow::Borrowed(shapes);
    }
    let is_written = |shape: &&Shape| match shape {
        Shape::Triangle { .. } | Shape::FlatTriangle { .. } => has_triangles,
        Shape::Sphere { .. } => has_spheres,
    };
    Cow::Owned(shapes.iter().filter(is_written).copied().collect())
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

/// A material that can be sent to a probe.
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

/// How an environment is sent: the size of the map (0 if there is none), and the radiance of each
/// pixel or, without a map, of all directions.
mod environment {
    use framework::scene::{Environment, EnvironmentMap};
    use glam::{UVec2, Vec3};
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(
        environment: &Environment,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match environment {
            Environment::Constant(radiance) => (UVec2::ZERO, vec![*radiance]),
            Environment::Map(map) => (map.size(), map.pixels().to_vec()),
        }
        .serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Environment, D::Error> {
        let (size, radiance) = <(UVec2, Vec<Vec3>)>::deserialize(deserializer)?;
        if let (UVec2::ZERO, [constant]) = (size, &radiance[..]) {
            return Ok(Environment::Constant(*constant));
        }
        let map = EnvironmentMap::new(size, radiance);
        map.map(Environment::Map).map_err(D::Error::custom)
    }
}

impl SceneData {
    /// Returns the data for a scene whose tree should be built.
    pub fn new(scene: &Scene, aim: Aim) -> Self {
        SceneData {
            environment: scene.environment.clone(),
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

/// A camera and the settings for paths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// The camera and its position.
    #[serde(with = "CameraDef")]
    pub camera: Camera,
    /// The settings.
    pub settings: PathSettings,
}

/// The settings for paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PathSettings {
    /// The maximum number of times a path is scattered.
    pub bounces: u32,
    /// The seed for all random numbers.
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
