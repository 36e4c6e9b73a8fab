//! A scene as it is sent to a probe, which cannot read files.

use framework::scene::{Camera, Material, Placement, Scene};
use glam::Vec3;
use protocol::{Shape, Tree};
use serde::{Deserialize, Serialize};

use crate::messages::Aim;

/// A scene without its camera.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SceneData {
    /// The radiance of the environment.
    pub environment: Vec3,
    /// The materials.
    pub materials: Vec<SceneMaterial>,
    /// All shapes.
    pub shapes: Vec<Shape>,
    /// The maximum number of primitives in a leaf.
    pub max_leaf_size: u32,
    /// The tree to traverse.
    pub tree: TreeSource,
    /// The first camera.
    pub aim: Aim,
    /// Whether each primitive gets its index as material, so that a recorded test names it.
    pub numbered: bool,
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

/// A material that can be sent.
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
            max_leaf_size: u32::try_from(scene.max_leaf_size).unwrap_or(u32::MAX),
            tree: TreeSource::Build,
            aim,
            numbered: false,
        }
    }

    /// Converts the data to a scene. If the shapes are numbered, each has a material of its own.
    pub(crate) fn into_scene(self) -> Scene {
        let mut materials: Vec<Material> =
            self.materials.iter().map(|material| material.0).collect();
        let mut shapes = self.shapes;
        if self.numbered {
            // A shape with an unknown material keeps one: an index beyond the end of the list.
            let of_shape = |shape: &Shape| materials.get(shape.material() as usize).copied();
            let missing = Material::Lambertian { albedo: Vec3::ZERO };
            materials = shapes
                .iter()
                .map(|shape| of_shape(shape).unwrap_or(missing))
                .collect();
            for (number, shape) in (0..).zip(&mut shapes) {
                set_material(shape, number);
            }
        }
        Scene {
            about: String::new(),
            camera: self.aim.camera(),
            environment: self.environment,
            materials,
            shapes,
            max_leaf_size: self.max_leaf_size as usize,
        }
    }
}

fn set_material(shape: &mut Shape, number: u32) {
    match shape {
        Shape::Triangle { material, .. }
        | Shape::FlatTriangle { material, .. }
        | Shape::Sphere { material, .. } => *material = number,
    }
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
