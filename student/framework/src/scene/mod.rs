//! Scenes: a camera, materials, shapes and the light from the environment.
//!
//! A scene is plain data, read from a JSON file by the module `read`. A submission converts it to
//! its own types.

mod camera;
mod environment;
mod error;
mod material;
mod mesh;
#[cfg(feature = "cli")]
mod obj;
mod polygon;
mod read;
#[cfg(feature = "cli")]
mod text_file;
mod triangulate;
mod value;

#[cfg(feature = "cli")]
use std::path::Path;

use glam::{UVec2, Vec3};
use protocol::Shape;
use serde::{Deserialize, Serialize};

pub use camera::{Camera, Placement};
pub use environment::{Environment, EnvironmentMap};
pub use error::SceneError;
pub use material::{Material, checker};

/// The maximum number of primitives in a leaf of a tree that is built for a picture.
const MAX_LEAF_SIZE: usize = 4;

/// The maximum number of pixels along one side of the film.
pub const MAX_FILM_SIDE: u32 = 16_384;

/// A scene that can be rendered.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Scene {
    /// The author's description of the scene. Can be empty.
    pub about: String,
    /// The camera and its position in the scene.
    pub camera: Camera,
    /// The light from the environment, which is visible where there is no shape.
    pub environment: Environment,
    /// The materials, indexed by `shape_materials`.
    pub materials: Vec<Material>,
    /// All shapes, in world space. Meshes are converted to triangles. Each shape's number is its
    /// index in this list, so that a hit identifies its shape.
    pub shapes: Vec<Shape>,
    /// For each shape, the index of its material.
    pub shape_materials: Vec<u32>,
    /// The `max_leaf_size` to pass to `Bvh::build`.
    pub max_leaf_size: usize,
}

impl Scene {
    /// Parses a scene from the text of a scene file that uses no other files.
    ///
    /// # Errors
    /// Fails if the text isn't a valid scene, or if the scene uses a mesh or an environment map.
    pub fn from_text(text: &str) -> Result<Scene, SceneError> {
        let message = |what: &str| {
            format!(
                "{what} are separate files, so a scene can only use them if it is read from a file"
            )
        };
        let load = read::LoadFiles {
            mesh: &|_| Err(message("meshes")),
            map: &|_, _| Err(message("environment maps")),
        };
        read::scene(text, &load).map(|(scene, _)| scene)
    }

    /// Loads a scene from a file. Paths of meshes are relative to the file's folder.
    ///
    /// # Errors
    /// Fails if the scene file or a mesh file cannot be read or is invalid. The message begins with
    /// the name of the file.
    #[cfg(feature = "cli")]
    pub fn load(path: &Path) -> Result<Scene, SceneError> {
        Scene::load_with_names(path).map(|(scene, _)| scene)
    }

    /// Does the same as [`Scene::load`] and also returns the names of the scene's materials.
    #[cfg(feature = "cli")]
    pub(crate) fn load_with_names(path: &Path) -> Result<(Scene, Vec<String>), SceneError> {
        let is_mesh = path.extension().is_some_and(|ending| ending == "obj");
        if let (true, Some(name)) = (is_mesh, path.file_name()) {
            let message = format!(
                "this is a mesh, not a scene. To show it in a scene, add this entry to its \
                 `shapes`: {{ \"mesh\": {{ \"file\": {:?}, \"material\": \"…\" }} }}; see \
                 scenes/README.md",
                name.to_string_lossy()
            );
            return Err(SceneError::new(None, message).in_file(path));
        }
        let text = text_file::read_text(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mesh =
            |file: &str| obj::load(&folder.join(file)).map_err(|error| format!("mesh: {error}"));
        let map = |file: &str, scale: f32| EnvironmentMap::load(&folder.join(file), scale);
        let load = read::LoadFiles {
            mesh: &mesh,
            map: &map,
        };
        read::scene(&text, &load).map_err(|error| error.in_file(path))
    }

    /// Returns the same scene with a film of a different size. If the scene file sets the sensor's
    /// aspect ratio, that ratio stays the same. Otherwise, the new film's aspect ratio is used.
    pub fn on_film(&self, film: UVec2) -> Scene {
        Scene {
            camera: self.camera.on_film(film),
            ..self.clone()
        }
    }

    /// Returns the material of the shape with this index, or `None` if the index is out of range.
    pub fn material_of(&self, shape: u32) -> Option<&Material> {
        let material = *self.shape_materials.get(shape as usize)?;
        self.materials.get(material as usize)
    }

    /// Returns the largest absolute value of any coordinate in the scene.
    pub fn extent(&self) -> f32 {
        let of_triangle = |[a, b, c]: [Vec3; 3]| a.abs().max(b.abs()).max(c.abs()).max_element();
        let of_shape = |shape: &Shape| match *shape {
            Shape::Triangle { vertices, .. } => of_triangle(vertices.map(|vertex| vertex.position)),
            Shape::FlatTriangle { corners, .. } => of_triangle(corners),
            Shape::Sphere { center, radius, .. } => center.abs().max_element() + radius,
        };
        let of_camera = self.camera.placement.position.abs().max_element();
        self.shapes.iter().map(of_shape).fold(of_camera, f32::max)
    }
}

#[cfg(all(test, feature = "cli"))]
mod file_tests;
#[cfg(test)]
mod tests;
